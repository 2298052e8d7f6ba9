// What a scene needs, for people and for programs.
#pragma once

#include <string>

#include "references/cli/report.hpp"
#include "references/studies/needs/needs.hpp"

namespace plumb::cli {

struct NeedsReport {
  std::string path;
  const Scene& scene;
  int width, height;
  double bound;
  references::Needs needs;
};

/// A page.
std::string as_text(const NeedsReport& report);
/// One object, see plumb needs --help.
Json to_json(const NeedsReport& report);

}  // namespace plumb::cli
