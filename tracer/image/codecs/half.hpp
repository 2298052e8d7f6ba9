// Half floats (IEEE 754 binary16), decoded without the processor's help.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace plumb::codecs {

/// Converts exactly, infinities and NaN included.
inline float float_of_half(std::uint16_t half) {
  constexpr int mantissa_bits = 10, bias = 15, largest = 31;
  const int exponent = half >> mantissa_bits & largest;
  const auto mantissa = static_cast<unsigned>(half & ((1U << mantissa_bits) - 1));
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000U) << 16;
  if (exponent == largest) return std::bit_cast<float>(sign | 0x7f800000U | mantissa << 13);
  const float value = exponent == 0 ? std::ldexp(static_cast<float>(mantissa), 1 - bias - mantissa_bits)
                                    : std::ldexp(static_cast<float>(mantissa + (1U << mantissa_bits)),
                                                 exponent - bias - mantissa_bits);
  return sign == 0 ? value : -value;
}

}  // namespace plumb::codecs
