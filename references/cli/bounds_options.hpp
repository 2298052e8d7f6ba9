// The options that bound a comparison.
#pragma once

#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/gates/bounds.hpp"

namespace plumb::cli {

/// --allow-over --relative --ignore --only
Table bounds_options(gates::Bounds& bounds);

}  // namespace plumb::cli
