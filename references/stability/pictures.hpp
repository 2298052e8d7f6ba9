// What a failure looks like: a small picture with the method just past the value at which it breaks.
#pragma once

#include <optional>
#include <string>

#include "references/stability/atlas.hpp"

namespace plumb::references::stability {

/// Where a picture is taken: 1.5 times the first value at which a row loses hits, meets itself or is 1 % off.
std::optional<double> picture_value(const Row& row);

/// PNG of a lit sphere under the condition; empty where the row does not break, or no picture shows it.
std::string failure_picture(const Condition& condition, const Row& row);

}  // namespace plumb::references::stability
