// What a render did, for people and for programs.
#pragma once

#include <string>

#include "tracer/engine/statistics.hpp"

namespace plumb::cli {

struct RenderStatistics {
  std::string scene, engine, real;
  int width = 0, height = 0;
  engine::Seconds read, write;
  bool has_counts = true;  ///< of rays and objects: the textbook tracer counts nothing
  engine::Statistics counts;
};

/// Several lines.
std::string as_text(const RenderStatistics& statistics);
/// One object, see the README.
std::string as_json(const RenderStatistics& statistics);

}  // namespace plumb::cli
