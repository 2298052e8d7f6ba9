// Tells how far two pictures are apart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "references/comparison/limit.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/pixel_place.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::comparison {

struct PixelPair {
  int x = 0;
  int y = 0;
  std::vector<float> test;
  std::vector<float> reference;
};

/// Errors are absolute differences of linear components. A pixel is over the tolerance when a component
/// differs by more than tolerance * max(1, |reference|). This is relative above 1, because float32 carries 24
/// bits: values above 8 are not even spaced as finely as 1e-6. A limit may allow more, see Limit. A pixel
/// with a component that is not finite, on either side, is counted apart: it is always over, and enters no
/// mean.
struct Comparison {
  std::size_t pixels = 0;       ///< number of pixels that count
  std::size_t non_finite = 0;   ///< number of pixels
  std::size_t pixels_over = 0;  ///< non-finite ones included
  double max_error = 0;
  double judged_error = 0;  ///< largest difference over max(1, |reference|), as the tolerance sees it
  double mean_error = 0;    ///< over all components of finite pixels
  double rms_error = 0;
  PixelPair worst;  ///< farthest beyond its tolerance; the first non-finite one if there is any
  bool agrees() const { return pixels_over == 0; }
};

/// Compares pictures of one size and channel count. Throws std::invalid_argument when these differ, saying
/// how, and for a limit that is negative or not finite.
Comparison compare(const Image& reference, const Image& test, Limit limit);
Comparison compare(int width, int height, int channels, const std::vector<float>& reference,
                   const std::vector<float>& test, Limit limit);

/// The same, row by row, for pictures that lie in files. Pixels that the mask leaves out enter nothing; at
/// least one must be left.
Comparison compare(const PixelRows& reference, const PixelRows& test, Limit limit,
                   const PixelMask& mask = {});

/// Returns the picture as rows, which do not keep it alive.
PixelRows rows_over(const Image& image);
/// Throws std::invalid_argument unless both have one width and height.
void expect_one_size(const Image& reference, const Image& test);

/// Places of the pixels that are over, row by row.
std::vector<PixelPlace> pixels_over(const Image& reference, const Image& test, Limit limit,
                                    const PixelMask& mask = {});

/// True if the three components of a pixel are within the limit of the reference.
bool is_within(const float* reference, const float* test, Limit limit);

}  // namespace plumb::comparison
