// The options that bound a comparison, and what bounds look like in results.
#pragma once

#include <string>
#include <vector>

#include "references/cli/commands.hpp"
#include "references/cli/report.hpp"
#include "references/gates/bounds.hpp"

namespace plumb::cli {

struct BoundsOptions {
  std::string allow_over = "0";
  double relative = 0;
  std::vector<std::string> ignore;
  std::vector<std::string> only;
};

/// --allow-over --relative --ignore --only
void add_bounds(CLI::App& app, BoundsOptions& options);

/// Throws std::invalid_argument naming the option.
references::Bounds bounds_of(const BoundsOptions& options, double tolerance);

/// What was allowed, what was ignored and why, as "bounds" of a result.
Json to_json(const references::Bounds& bounds, const references::BoundedComparison& result);

/// The same in a sentence; empty when nothing but the tolerance decides.
std::string bounds_text(const references::Bounds& bounds, const references::BoundedComparison& result);

}  // namespace plumb::cli
