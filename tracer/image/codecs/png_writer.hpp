// PNG (W3C, second edition) of 8-bit sRGB, in memory. OpenImageIO's start alone takes longer than most
// renders.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb::codecs {

/// The bytes of a file that holds width x height pixels of 8 bits, interleaved r g b, row 0 on top, both
/// sizes at least 1, and that says they are sRGB. Throws std::bad_alloc.
using WritePng = std::string (*)(int width, int height, const std::vector<std::uint8_t>& rgb);

inline constexpr const char* write_png_symbol = "plumb_codecs_write_png";

std::string write_png(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace plumb::codecs
