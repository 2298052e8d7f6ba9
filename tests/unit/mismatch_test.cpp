// What likely_cause() names, and what it must not, for pictures of whole numbers.
#include "references/comparison/mismatch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace plumb::tests {
namespace {

using Curve = std::function<double(double)>;

constexpr int width = 64;
constexpr int height = 16;
constexpr double tolerance = 1e-6;

/// Values from 0 to 1.2, none of them a whole number of steps.
ImageFile reference_picture() {
  ImageFile file{width, height, 3, Sample::float32, {}, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    file.values.push_back(static_cast<float>(i * 7919 % 3071) / 2560.0F);
  return file;
}

ImageFile changed(const Curve& curve) {
  ImageFile file = reference_picture();
  for (float& value : file.values) value = static_cast<float>(curve(static_cast<double>(value)));
  return file;
}

Curve rounded(double most) {
  return [most](double v) { return std::round(std::min(v, 1.0) * most) / most; };
}
Curve truncated(double most) {
  return [most](double v) { return std::floor(std::min(v, 1.0) * most) / most; };
}

std::optional<comparison::LikelyCause> cause_of(ImageFile test, ImageFile reference = reference_picture()) {
  const PixelRows r = rows_of(std::move(reference)), t = rows_of(std::move(test));
  return comparison::likely_cause(r, t, tolerance, comparison::compare(r, t, tolerance));
}

std::string name_of(ImageFile test) {
  const auto cause = cause_of(std::move(test));
  return cause ? cause->name : "none";
}

TEST(LikelyCause, SixteenBitsRoundedOrTruncatedAreNamed) {
  EXPECT_EQ(name_of(changed(rounded(65535))), "rounded_to_16_bits");
  EXPECT_EQ(name_of(changed(truncated(65535))), "truncated_to_16_bits");
  const auto tone_mapped = [](double v) { return v / (v + 1); };
  EXPECT_EQ(name_of(changed([&](double v) { return rounded(65535)(tone_mapped(v)); })),
            "tone_mapped_rounded_to_16_bits");
  const auto srgb = [](double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  };
  EXPECT_EQ(name_of(changed([&](double v) { return rounded(65535)(srgb(std::min(v, 1.0))); })),
            "srgb_encoded_rounded_to_16_bits");
}

TEST(LikelyCause, TheBoundOfSixteenBitsIsHalfAStep) {
  const auto cause = cause_of(changed(rounded(65535)));
  ASSERT_TRUE(cause);
  EXPECT_EQ(cause->because, "half a step of 16 bits is 1/131070");
  EXPECT_EQ(cause->pixels_over, 0U);
}

/// Their values are levels of 16 bits, too: 65535 = 257 * 255.
TEST(LikelyCause, EightBitsAreStillNamedAsSuch) {
  EXPECT_EQ(name_of(changed(rounded(255))), "rounded_to_8_bits");
  EXPECT_EQ(name_of(changed(truncated(255))), "truncated_to_8_bits");
}

TEST(LikelyCause, OneValueThatIsNoLevelOrOneStepOffContradictsSixteenBits) {
  ImageFile no_level = changed(rounded(65535));
  no_level.values[100] += 0.3F / 65535;
  EXPECT_EQ(name_of(no_level), "none");
  ImageFile step_off = changed(rounded(65535));
  step_off.values[100] += 1.0F / 65535;
  EXPECT_EQ(name_of(step_off), "none");
}

/// A reference of 16 bits was not truncated to 16 bits, however little darker the test picture is.
TEST(LikelyCause, OneStepBetweenPicturesOfSixteenBitsIsNoTruncation) {
  ImageFile reference = changed(rounded(65535));
  reference.sample = Sample::bits16;
  ImageFile darker = reference;
  darker.values[100] -= 1.0F / 65535;
  EXPECT_FALSE(cause_of(darker, reference));
  reference.sample = Sample::float32;
  const auto taken_for_floats = cause_of(darker, reference);
  ASSERT_TRUE(taken_for_floats);
  EXPECT_EQ(taken_for_floats->name, "truncated_to_16_bits");
}

}  // namespace
}  // namespace plumb::tests
