// Writes the difference of two pictures as a picture.
#pragma once

#include <string>

#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::comparison {

/// What was written. `scale` is 1 over the difference that is white; 1 in files of floats.
struct DifferenceImage {
  double scale = 1;
  bool is_float = false;
  bool has_non_finite = false;
  bool leaves_out_channels = false;  ///< a second channel, or those after the third
};

/// Writes |test - reference| of the first three channels, or one channel three times; black where the mask
/// leaves pixels out. EXR and PFM hold it as it is: linear, NaN where a value is not finite. Other formats
/// hold it scaled, so that the largest difference is white, in their usual encoding; what is not finite is
/// magenta. Throws std::invalid_argument for a format that is not written, std::runtime_error naming the
/// path; then nothing is written.
DifferenceImage write_difference(const std::string& path, const PixelRows& reference, const PixelRows& test,
                                 const PixelMask& mask);

}  // namespace plumb::comparison
