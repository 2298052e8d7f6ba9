// Reads the chunks of a PNG (W3C, second edition).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tracer/image/codecs/codecs.hpp"

namespace plumb::codecs {

enum class PngColour { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgb_alpha = 6 };

struct Png {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  unsigned depth = 0;  ///< number of bits of a sample
  PngColour colour = PngColour::grey;
  bool is_interlaced = false;
  bool is_animated = false;
  bool has_exif = false;
  std::size_t bytes_after = 0;    ///< number of bytes behind the last chunk
  std::string_view palette;       ///< r g b of 8 bits for each index
  std::string_view transparency;  ///< alphas of a palette, or the one transparent colour
  std::string deflated;

  std::size_t samples() const;  ///< number per pixel in the file
  std::size_t row_bytes(std::size_t pixels) const { return (pixels * samples() * depth + 7) / 8; }
  bool is_transparent() const { return !transparency.empty(); }
  /// Number of channels once a palette is looked up and a transparent colour has become alpha.
  std::size_t channels() const;
};

/// Checks all check sums. Throws std::runtime_error naming the file when it is incomplete or its header makes
/// no sense.
Png read_png_chunks(const Source& source);

}  // namespace plumb::codecs
