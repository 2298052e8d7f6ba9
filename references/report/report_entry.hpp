// What the report says of one scene.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "references/comparison/limit.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/image.hpp"

namespace plumb::report {

/// Why a pixel is over the tolerance.
struct PixelNote {
  int x;
  int y;
  std::string cause;  ///< a key of the budget, e.g. "silhouette" or "unexplained"
  std::string text;   ///< several lines, the ray tree; may be empty
};

struct ReportEntry {
  std::string name;  ///< path of the scene, or the names of the two pictures
  /// The scene's object of --json; any key may be absent. "not_compared" says why there are no figures.
  nlohmann::ordered_json result;
  std::shared_ptr<const Image> reference, test;  ///< of one size; both null for a scene in trouble
  /// Whether its values are what a screen shows, as files of 8 bits have them; else they are linear.
  bool reference_is_encoded = false, test_is_encoded = false;
  std::vector<PixelNote> notes;  ///< pixels over the tolerance
  std::optional<comparison::Limit>
      tolerance;                ///< marks every pixel over it "over"; for pictures without notes
  comparison::PixelMask mask;   ///< marks every pixel that does not count "ignored"
  std::string explain_command;  ///< " X Y" is added, e.g. "plumb explain scene.sdf"; may be empty
  std::string approve_command;  ///< makes this picture the baseline; may be empty
};

}  // namespace plumb::report
