#include "tracer/image/encode.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {

float tone_mapped(float c) {
  if (!(c > 0)) return 0;
  return std::isinf(c) ? 1.0F : c / (c + 1);
}

std::uint8_t truncated_to_8_bits(float c) {
  if (!(c > 0)) return 0;
  return static_cast<std::uint8_t>(std::min(255.0F * c, 255.0F));
}

std::uint8_t srgb_8_bits(float c) {
  if (!(c > 0)) return 0;
  const float x = std::min(c, 1.0F);
  const float curve = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * curve));
}

std::vector<std::uint8_t> encode_8_bits(const Image& image, Encoding encoding) {
  std::vector<std::uint8_t> bytes(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(), [&](float c) {
    switch (encoding) {
      case Encoding::srgb:
        return srgb_8_bits(c);
      case Encoding::course:
        return truncated_to_8_bits(tone_mapped(c));
      case Encoding::linear:
        break;
    }
    return truncated_to_8_bits(c);
  });
  return bytes;
}

}  // namespace plumb
