// The pixel difference of pixelmatch and odiff.
#pragma once

#include <cstdint>

namespace plumb::gate_power {

/// Interleaved r g b, row 0 on top.
struct ByteImage {
  int width;
  int height;
  const std::uint8_t* rgb;

  const std::uint8_t* pixel(int x, int y) const { return rgb + 3 * (y * width + x); }
};

/// Pixels whose colours are farther apart than the threshold (0..1) of the largest distance in YIQ
/// (Y. Kotsarenko, F. Ramos, "Measuring perceived color difference using YIQ NTSC transmission color space in
/// mobile applications", 2010). With `skips_antialiasing` those are left out that look like an anti-aliased
/// edge in either picture (V. Vysniauskas, "Anti-aliased pixel and intensity slope detector", 2009).
int differing_pixels(const ByteImage& a, const ByteImage& b, double threshold, bool skips_antialiasing);

}  // namespace plumb::gate_power
