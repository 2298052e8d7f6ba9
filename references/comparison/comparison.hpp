// How far two pictures are apart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "references/comparison/limit.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/pixel_place.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::references {

struct PixelPair {
  int x = 0;
  int y = 0;
  std::vector<float> test;
  std::vector<float> reference;
};

/// Errors are absolute differences of linear components. A pixel is over the tolerance when a component
/// differs by more than tolerance * max(1, |reference|): relative above 1, because float32 carries 24 bits
/// and values above 8 are not even spaced as finely as 1e-6. A limit may allow more, see Limit. A pixel with
/// a component that is not finite, on either side, is counted first and apart: it is always over, and enters
/// no mean.
struct Comparison {
  std::size_t pixels = 0;       ///< that count
  std::size_t non_finite = 0;   ///< pixels
  std::size_t pixels_over = 0;  ///< non-finite ones included
  double max_error = 0;
  double judged_error =
      0;                  ///< largest difference over max(1, |reference|): what the tolerance is held against
  double mean_error = 0;  ///< over all finite components
  double rms_error = 0;
  PixelPair worst;  ///< farthest beyond its tolerance; the first non-finite one if there is any
  bool agrees() const { return pixels_over == 0; }
};

/// Pictures of one size and channel count. Throws std::invalid_argument otherwise, saying what differs, and
/// for a limit that is negative or not finite.
Comparison compare(const Image& reference, const Image& test, Limit limit);
Comparison compare(int width, int height, int channels, const std::vector<float>& reference,
                   const std::vector<float>& test, Limit limit);

/// The same, row by row, for pictures that lie in files. Pixels that the mask leaves out enter nothing.
Comparison compare(const PixelRows& reference, const PixelRows& test, Limit limit,
                   const PixelMask& mask = {});

/// The picture as rows, which do not keep it.
PixelRows rows_over(const Image& image);
/// Throws std::invalid_argument unless they are.
void expect_one_size(const Image& reference, const Image& test);

/// Places of the pixels that are over, row by row.
std::vector<PixelPlace> pixels_over(const Image& reference, const Image& test, Limit limit,
                                    const PixelMask& mask = {});

/// Whether one pixel of three components is within the limit of the reference.
bool is_within(const float* reference, const float* test, Limit limit);

}  // namespace plumb::references
