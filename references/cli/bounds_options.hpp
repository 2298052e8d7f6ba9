// The options that bound a comparison, and what bounds look like in results.
#pragma once

#include <string>
#include <vector>

#include "references/cli/command_line.hpp"
#include "references/cli/report.hpp"
#include "references/gates/bounds.hpp"

namespace plumb::cli {

/// --allow-over --relative --ignore --only
Table bounds_options(references::Bounds& bounds);

/// What was allowed, what was ignored and why, as "bounds" of a result.
Json to_json(const references::Bounds& bounds, const references::BoundedComparison& result);

/// The same in a sentence; empty when nothing but the tolerance decides.
std::string bounds_text(const references::Bounds& bounds, const references::BoundedComparison& result);

}  // namespace plumb::cli
