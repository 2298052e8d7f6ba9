// Asks the oracle, the textbook tracer in 113 bits, for some pixels of a picture.
#pragma once

#include <vector>

#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/sampled_pixels.hpp"

namespace plumb::truth {

struct OraclePixel {
  PixelPlace place;
  Rgbd colour;  ///< linear, rounded to double
};

struct OracleSample {
  std::vector<OraclePixel> pixels;
  std::size_t cut = 0;  ///< number of pixels with more than most_rays_of_pixel rays, which are left out
};

/// Traces the pixels in their order until the work is over; with n * n samples in the grid pattern the
/// mean of those. Throws std::invalid_argument for samples in another pattern, and as the tracer does.
OracleSample ask_oracle(const Scene& scene, const Camera& camera, const RenderJob& job,
                        const std::vector<PixelPlace>& places, textbook::Work& work);

/// Returns the pixels in which two pictures of one size differ most, the worst first; at most `most`.
std::vector<PixelPlace> most_different(const Image& a, const Image& b, std::size_t most);

}  // namespace plumb::truth
