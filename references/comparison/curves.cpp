#include "references/comparison/curves.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::comparison::curves {

double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double tone_mapped(double linear) { return linear > 0 ? linear / (linear + 1) : 0; }

float half_rounded(float value) {
  // 11 significant bits down to 2^-14, a fixed step below.
  int exponent = 0;
  std::frexp(value, &exponent);
  const double step = std::ldexp(1.0, std::max(exponent - 1, -14) - 10);
  return static_cast<float>(std::nearbyint(value / step) * step);
}

bool is_level(float value, int most) {
  constexpr double roundings = 4e-7;  // of the floats that a reader may compute k / most in
  const double scaled = static_cast<double>(value) * most, level = std::nearbyint(scaled);
  return level >= 0 && level <= most && std::abs(scaled - level) < roundings * most;
}

}  // namespace plumb::comparison::curves
