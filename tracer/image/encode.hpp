// The steps after the render, from linear float colours to what a file holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracer/image/image.hpp"

namespace plumb {

enum class Encoding {
  linear,  ///< the colours themselves, without a curve
  srgb,    ///< the sRGB curve (IEC 61966-2-1), rounded to 8 bits
  course,  ///< tone map c / (c + 1) of the 2020 sheet, then truncated to 8 bits as the framework does
};

/// Sheet of 2020: c / (c + 1). A negative colour or a NaN becomes 0.
float tone_mapped(float c);

/// As in the framework's PPM: unsigned(clamp(255 c)), truncated. A NaN becomes 0.
std::uint8_t truncated_to_8_bits(float c);

/// The sRGB curve of IEC 61966-2-1, clamped to 0..1 and rounded to 8 bits. A NaN becomes 0.
std::uint8_t srgb_8_bits(float c);

/// Returns interleaved r g b, row 0 on top. Linear colours are truncated to 8 bits.
std::vector<std::uint8_t> encode_8_bits(const Image& image, Encoding encoding);

}  // namespace plumb
