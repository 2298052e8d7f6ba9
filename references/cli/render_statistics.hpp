// What a render did, for people and for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "references/studies/needs/choice.hpp"
#include "tracer/engine/statistics.hpp"

namespace plumb::cli {

/// Why a configuration was chosen.
struct ChosenForError {
  double bound;
  int asked_depth;
  std::size_t oracle_pixels, pixels;
  references::Candidate candidate;
  std::vector<references::Candidate> tried;
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
/// One object, see plumb render --stats-json.
std::string as_json(const RenderStatistics& statistics);

}  // namespace plumb::cli
