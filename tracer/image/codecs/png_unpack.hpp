// Turns the samples of a PNG into components: palettes, transparent colours, bits, 16 bits, interlacing.
#pragma once

#include "tracer/image/codecs/png_file.hpp"

namespace plumb::codecs {

/// One pass of a picture, with a part of its pixels. Without interlacing there is one pass.
struct PngPass {
  std::size_t x, y, step_x, step_y;  ///< the first pixel, and the distance between pixels
  std::size_t width, height;         ///< in pixels of the pass
};
std::vector<PngPass> passes_of(const Png& png);

/// Returns the number of inflated bytes of all passes. Each row begins with the number of its filter.
std::size_t inflated_bytes(const Png& png);

/// Fills `rows` from inflated bytes, whose filters it undoes in place: 8 bits a component, or float32 for 16
/// bits.
void unpack_png(const Source& source, const Png& png, std::uint8_t* inflated, PixelRows& rows);

}  // namespace plumb::codecs
