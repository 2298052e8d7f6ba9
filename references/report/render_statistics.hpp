// What a render did, for people.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "references/studies/needs/choice.hpp"
#include "tracer/engine/statistics.hpp"

namespace plumb::report {

/// Why a configuration was chosen.
struct ChosenForError {
  double bound;
  int asked_depth;
  std::size_t oracle_pixels, pixels;
  studies::Candidate candidate;
  std::vector<studies::Candidate> tried;
  std::string reason;  ///< a few lines
};

struct RenderStatistics {
  std::string scene, engine, real;
  int width = 0, height = 0;
  engine::Seconds read, write;
  bool has_counts = true;  ///< of rays and objects; the textbook tracer counts nothing
  engine::Statistics counts;
  std::optional<ChosenForError> chosen;  ///< when --error chose
};

/// Returns several lines.
std::string as_text(const RenderStatistics& statistics);

/// Each kind of rays with its name and number.
using RayCounts = std::vector<std::pair<const char*, std::uint64_t>>;
RayCounts rays_of(const engine::Statistics& counts);

}  // namespace plumb::report
