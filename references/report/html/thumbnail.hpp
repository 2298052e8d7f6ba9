// Makes small pictures for the overview.
#pragma once

#include <string>

#include "tracer/image/image.hpp"

namespace plumb::report {

/// A PNG of at most 144 pixels a side: the mean of what each of its pixels covers, sRGB, clamped. Values that
/// are encoded already, as a screen shows them, get no curve once more.
std::string thumbnail(const Image& image, bool is_encoded = false);

/// Returns a grey PNG of the same size: the largest error, relative above 1, that each of its pixels covers.
/// 0 is 1e-8 or less, 255 is 1 or more or not finite, logarithmic between.
std::string error_thumbnail(const Image& reference, const Image& test);

}  // namespace plumb::report
