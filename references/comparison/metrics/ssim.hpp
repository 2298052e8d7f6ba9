// SSIM, the structural similarity of two pictures.
// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error Visibility to
// Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004, section III.
#pragma once

#include <optional>

#include "references/comparison/metrics/picture.hpp"

namespace plumb::comparison {

/// Returns the mean over all 11 x 11 windows that lie inside (Gaussian of 1.5 pixels, K1 = 0.01, K2 = 0.03).
/// It is that of the luminance 0.2126 r + 0.7152 g + 0.0722 b of the values as they stand, or of the first
/// channel when there are fewer than three. `peak` is the paper's dynamic range L. It is 1 for equal
/// pictures, and nothing when no window fits.
std::optional<double> ssim(const PictureView& reference, const PictureView& test, double peak);

}  // namespace plumb::comparison
