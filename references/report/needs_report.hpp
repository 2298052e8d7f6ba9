// What a scene needs, for people.
#pragma once

#include <string>
#include <vector>

#include "references/studies/needs/needs.hpp"

namespace plumb::report {

struct NeedsReport {
  std::string path;
  const Scene& scene;
  int width, height;
  double bound;
  studies::Needs needs;
};

/// The names of those of the scene's things that have these numbers.
template <class Ids, class Things>
std::vector<std::string> names_of(const Ids& ids, const Things& things) {
  std::vector<std::string> names;
  for (const auto id : ids) names.push_back(things[id].name);
  return names;
}

/// A page.
std::string as_text(const NeedsReport& report);
/// The errors that are looked at, the largest first: the report's own and a few that all know.
std::vector<double> bounds_of(const NeedsReport& report);

}  // namespace plumb::report
