// The sRGB table of encode_8_bits() gives the byte that srgb_8_bits() computes with a power.
#include "tracer/image/encode.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace plumb {
namespace {

std::vector<std::uint8_t> encoded(const std::vector<float>& colours, Encoding encoding) {
  Image image(static_cast<int>(colours.size()) / 3, 1);
  image.rgb = colours;
  return encode_8_bits(image, encoding);
}

void expect_as_computed(const std::vector<float>& colours) {
  const auto bytes = encoded(colours, Encoding::srgb);
  ASSERT_EQ(bytes.size(), colours.size());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    ASSERT_EQ(bytes[i], srgb_8_bits(colours[i])) << std::hexfloat << colours[i];
}

/// Floats of 0 to 1, in their order, every `step`-th.
std::vector<float> spread(std::uint32_t step) {
  std::vector<float> colours;
  for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.0F); bits += step)
    colours.push_back(std::bit_cast<float>(bits));
  return colours;
}

/// The least float that becomes a byte of `level` or more, between one that does not and one that does.
std::uint32_t first_of(int level, std::uint32_t low, std::uint32_t high) {
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (srgb_8_bits(std::bit_cast<float>(middle)) < level ? low : high) = middle;
  }
  return high;
}

TEST(Encode, TheSrgbTableHoldsAllOverItsRange) {
  const auto colours = spread(997);
  ASSERT_GT(colours.size(), 1'000'000U);
  expect_as_computed(colours);
}

TEST(Encode, TheSrgbTableHoldsWhereTheByteChanges) {
  for (int level = 1; level <= 255; ++level) {
    const std::uint32_t first = first_of(level, 0, std::bit_cast<std::uint32_t>(1.0F));
    ASSERT_EQ(srgb_8_bits(std::bit_cast<float>(first)), level);
    std::vector<float> colours;
    for (std::uint32_t bits = first - 60; bits <= first + 60; ++bits)
      colours.push_back(std::bit_cast<float>(bits));
    expect_as_computed(colours);
  }
}

TEST(Encode, TheSrgbTableHoldsAtTheEdgesOfItsBuckets) {
  std::vector<float> colours;
  for (std::uint32_t bits = std::uint32_t{1} << 16; bits <= std::bit_cast<std::uint32_t>(2.0F);
       bits += std::uint32_t{1} << 16) {
    for (const std::uint32_t near : {bits - 1, bits, bits + 1}) colours.push_back(std::bit_cast<float>(near));
  }
  expect_as_computed(colours);
}

TEST(Encode, ColoursOutsideOfZeroToOneAreBlackAndFull) {
  using Limits = std::numeric_limits<float>;
  const std::vector<float> colours{
      -1, -0.0F, -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::denorm_min(),
      1,  1.5F,  Limits::infinity()};
  EXPECT_EQ(encoded(colours, Encoding::srgb), (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255}));
  EXPECT_EQ(encoded(colours, Encoding::linear), (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255}));
  EXPECT_EQ(encoded(colours, Encoding::course), (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 127, 153, 255}));
}

}  // namespace
}  // namespace plumb
