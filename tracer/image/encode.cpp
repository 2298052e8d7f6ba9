#include "tracer/image/encode.hpp"

#include <algorithm>
#include <array>
#include <bit>
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

namespace {

/// Returns the bits of the smallest colour that becomes at least level n, from 1 to 255. It lies near where
/// the inverse of the curve says.
std::uint32_t least_of_level(std::uint32_t n) {
  const double curve = (n - 0.5) / 255;
  const double guess = curve <= 0.04045 ? curve / 12.92 : std::pow((curve + 0.055) / 1.055, 2.4);
  auto c = static_cast<float>(guess);
  while (srgb_8_bits(c) >= n) c = std::nextafter(c, 0.0F);
  while (srgb_8_bits(c) < n) c = std::nextafter(c, 1.0F);
  return std::bit_cast<std::uint32_t>(c);
}

/// Does srgb_8_bits() by a table, with the same results. Colours that share the exponent and 7 bits of
/// mantissa are a bucket. The levels are so far apart that a bucket has at most two. The other 16 bits of
/// mantissa are added to the bucket's number. From the second level's smallest colour on they carry into its
/// upper half, the level.
class SrgbTable {
 public:
  SrgbTable() {
    std::uint32_t level = 0;
    std::uint32_t next = least_of_level(1);
    for (std::uint32_t i = 0; i < buckets_.size(); ++i) {
      const std::uint32_t end = (first_bucket + i + 1) << low_bits;
      const bool has_next = level < 255 && next < end;
      buckets_[i] = (level << low_bits) + (has_next ? end - next : 0);
      if (has_next && ++level < 255) next = least_of_level(level + 1);
    }
  }
  std::vector<std::uint8_t> operator()(const std::vector<float>& colours) const {
    std::vector<std::uint8_t> bytes(colours.size());
    for (std::size_t done = 0; done < bytes.size(); done += block)
      encode(&colours[done], std::min(block, bytes.size() - done), &bytes[done]);
    return bytes;
  }

 private:
  /// There are two loops, so that the first becomes vectors and needs no branches on colours.
  void encode(const float* colours, std::size_t count, std::uint8_t* bytes) const {
    std::array<std::uint32_t, block> clamped;
    for (std::size_t i = 0; i < count; ++i) {
      const float raised = colours[i] > lowest ? colours[i] : lowest;  // a NaN, too
      clamped[i] = std::bit_cast<std::uint32_t>(raised < 1 ? raised : 1.0F);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t bucket = buckets_[(clamped[i] >> low_bits) - first_bucket];
      bytes[i] = static_cast<std::uint8_t>((bucket + (clamped[i] & low_mask)) >> low_bits);
    }
  }

  static constexpr std::size_t block = 256;
  static constexpr float lowest = 0x1p-13F;  // black still
  static constexpr int low_bits = 16;
  static constexpr std::uint32_t low_mask = (1U << low_bits) - 1;
  static constexpr std::uint32_t first_bucket = std::bit_cast<std::uint32_t>(lowest) >> low_bits;
  static constexpr std::uint32_t last_bucket = std::bit_cast<std::uint32_t>(1.0F) >> low_bits;
  std::array<std::uint32_t, last_bucket - first_bucket + 1> buckets_{};
};

template <class Encode>
std::vector<std::uint8_t> each(const std::vector<float>& colours, Encode encode) {
  std::vector<std::uint8_t> bytes(colours.size());
  std::transform(colours.begin(), colours.end(), bytes.begin(), encode);
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encode_8_bits(const Image& image, Encoding encoding) {
  if (encoding == Encoding::srgb) {
    static const SrgbTable table;
    return table(image.rgb);
  }
  if (encoding == Encoding::course)
    return each(image.rgb, [](float c) { return truncated_to_8_bits(tone_mapped(c)); });
  return each(image.rgb, [](float c) { return truncated_to_8_bits(c); });
}

}  // namespace plumb
