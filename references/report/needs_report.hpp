// What a scene needs, for people.
#pragma once

#include <string>
#include <vector>

#include "references/studies/needs/needs.hpp"

namespace plumb::references {

struct NeedsReport {
  std::string path;
  const Scene& scene;
  int width, height;
  double bound;
  Needs needs;
};

/// A page.
std::string as_text(const NeedsReport& report);
/// The errors that are looked at, the largest first: the report's own and a few that all know.
std::vector<double> bounds_of(const NeedsReport& report);

}  // namespace plumb::references
