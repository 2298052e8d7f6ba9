// Shows what a failure looks like: a small picture with the method just past the value at which it breaks.
#pragma once

#include <optional>
#include <string>

#include "references/studies/stability/atlas.hpp"

namespace plumb::studies::stability {

/// Returns the first value at which a row loses hits, meets itself or is 1 % off; if it never is, that of its
/// finest break. A picture is taken at 1.5 times that. Expects a row that breaks.
double first_break(const Row& row);

/// Two PNG files, or why there are none.
struct FailurePicture {
  std::string seen;     ///< the scene as the method shows it
  std::string errors;   ///< its error to 113 bits: black to 1e-8, white from 1 on
  std::string refused;  ///< why there is none
};

/// Returns nothing where the row does not break, or where no picture shows it: differences of t alone,
/// conditions of single rays, and what a renderer does not do.
std::optional<FailurePicture> failure_picture(const Condition& condition, const Row& row);

}  // namespace plumb::studies::stability
