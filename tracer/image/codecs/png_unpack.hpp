// From the samples of a PNG to components: palettes, transparent colours, bits, 16 bits, interlacing.
#pragma once

#include "tracer/image/codecs/png_file.hpp"

namespace plumb::codecs {

/// A picture that comes in passes, each with fewer pixels; without interlacing there is one.
struct PngPass {
  std::size_t x, y, step_x, step_y;  ///< the first pixel, and how far apart they are
  std::size_t width, height;         ///< pixels of the pass
};
std::vector<PngPass> passes_of(const Png& png);

/// Bytes of all passes once inflated: each row begins with the number of its filter.
std::size_t inflated_bytes(const Png& png);

/// From inflated bytes, whose filters it undoes in place. 8 bits a component, or float32 for 16 bits.
void unpack_png(const Source& source, const Png& png, std::uint8_t* inflated, PixelRows& rows);

}  // namespace plumb::codecs
