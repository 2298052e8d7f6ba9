// What a report shows of a scene besides its figures.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "references/attribution/attribution.hpp"
#include "references/comparison/comparison.hpp"
#include "tracer/image/image.hpp"

namespace plumb::references {

struct Pictures {
  std::shared_ptr<const Image> reference;
  std::shared_ptr<const Image> ours;
  /// Rays of pixels that are over, as explain_text has them: of 300 at most, and 4 MB of text.
  std::vector<std::pair<PixelPlace, std::string>> explanations;
};

/// The pictures of the job with the rays of the pixels that a reader will ask about.
std::shared_ptr<const Pictures> pictures_of(const AttributionJob& job, const Comparison& comparison,
                                            const Budget& budget);

}  // namespace plumb::references
