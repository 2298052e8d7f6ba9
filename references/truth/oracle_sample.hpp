// The oracle: the textbook tracer in 113 bits, on some pixels of a picture.
#pragma once

#include <vector>

#include "references/attribution/look.hpp"
#include "tracer/image/image.hpp"

namespace plumb::references {

struct OraclePixel {
  PixelPlace place;
  Rgbd colour;  ///< linear, rounded to double
};

struct OracleSample {
  std::vector<OraclePixel> pixels;
  std::size_t cut = 0;  ///< pixels with more than most_rays_of_pixel rays, which are not looked at
};

/// Traces the pixels in their order until `most_units` are spent; with n * n samples in the grid pattern the
/// mean of those. Throws std::invalid_argument for samples in another pattern, and as the tracer does.
OracleSample ask_oracle(const Scene& scene, const Camera& camera, const RenderJob& job,
                        const std::vector<PixelPlace>& places, double most_units);

/// The pixels in which two pictures of one size differ most, the worst first.
std::vector<PixelPlace> most_different(const Image& a, const Image& b, std::size_t most);

}  // namespace plumb::references
