// The measure of how far two pictures are apart, against sums done by hand.
#include "references/comparison/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumb::tests {
namespace {

using comparison::compare;
using comparison::Comparison;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

Image image_of(int width, int height, const std::vector<float>& rgb) {
  Image image(width, height);
  EXPECT_EQ(image.rgb.size(), rgb.size());
  image.rgb = rgb;
  return image;
}

/// One pixel whose first component is `value`.
Image pixel_of(float value) { return image_of(1, 1, {value, 0.5F, 0.25F}); }

TEST(Comparison, EqualPicturesAgreeWithoutAnyTolerance) {
  const Image image = image_of(2, 1, {0, 0.1F, 0.2F, 7, 8, 1e30F});
  const Comparison c = compare(image, image, 0);
  EXPECT_TRUE(c.agrees());
  EXPECT_EQ(c.pixels, 2U);
  EXPECT_EQ(c.non_finite, 0U);
  EXPECT_EQ(c.max_error, 0);
  EXPECT_EQ(c.mean_error, 0);
  EXPECT_EQ(c.rms_error, 0);
}

TEST(Comparison, MaximumMeanAndRmsAreThoseDoneByHand) {
  // Differences: 0, 0.25, 0.5 | 0, 0, 0 | 0.125, 0, 0 | 0, 0, 1; all exact in float32.
  const Image reference = image_of(2, 2, {0, 0, 0, 0.5F, 0.5F, 0.5F, 0.25F, 0, 0, 0, 0, 0});
  const Image test = image_of(2, 2, {0, 0.25F, -0.5F, 0.5F, 0.5F, 0.5F, 0.125F, 0, 0, 0, 0, 1});
  const Comparison c = compare(reference, test, 0.2);
  EXPECT_EQ(c.pixels, 4U);
  EXPECT_EQ(c.pixels_over, 2U);
  EXPECT_EQ(c.non_finite, 0U);
  EXPECT_DOUBLE_EQ(c.max_error, 1);
  EXPECT_DOUBLE_EQ(c.mean_error, 1.875 / 12);
  EXPECT_DOUBLE_EQ(c.rms_error, std::sqrt((0.0625 + 0.25 + 0.015625 + 1) / 12));
  EXPECT_FALSE(c.agrees());
}

TEST(Comparison, TheWorstPixelIsShownWithBothItsColours) {
  const Image reference = image_of(3, 2, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.5F, 0.25F, 0.125F});
  Image test = reference;
  test.pixel(0, 0)[0] = 0.125F;
  test.pixel(2, 1)[1] = 0.75F;
  const Comparison c = compare(reference, test, 0);
  EXPECT_EQ(c.worst.x, 2);
  EXPECT_EQ(c.worst.y, 1);
  EXPECT_EQ(c.worst.test, (std::vector<float>{0.5F, 0.75F, 0.125F}));
  EXPECT_EQ(c.worst.reference, (std::vector<float>{0.5F, 0.25F, 0.125F}));
}

TEST(Comparison, TheWorstIsTheFarthestBeyondItsToleranceNotTheLargestDifference) {
  // 2 of 100 is less than 0.125 of 1.
  const Image reference = image_of(2, 1, {100, 0, 0, 0, 0, 0});
  const Image test = image_of(2, 1, {102, 0, 0, 0.125F, 0, 0});
  const Comparison c = compare(reference, test, 1e-3);
  EXPECT_EQ(c.worst.x, 1);
  EXPECT_EQ(c.max_error, 2);
}

TEST(Comparison, APixelIsCountedOnceHoweverManyComponentsAreOver) {
  EXPECT_EQ(compare(image_of(1, 1, {0, 0, 0}), image_of(1, 1, {1, 1, 1}), 0.5).pixels_over, 1U);
}

TEST(Comparison, WhatIsNotFiniteAlwaysFails) {
  struct Case {
    const char* what;
    float reference;
    float test;
  };
  for (const Case& c : {Case{"NaN in ours", 0.5F, nan}, Case{"NaN in the reference", nan, 0.5F},
                        Case{"NaN in both", nan, nan}, Case{"+Inf in both", infinity, infinity},
                        Case{"+Inf and -Inf", infinity, -infinity}, Case{"+Inf in ours", 1, infinity},
                        Case{"-Inf in the reference", -infinity, 1}}) {
    const Comparison result = compare(pixel_of(c.reference), pixel_of(c.test), 1e30);
    EXPECT_EQ(result.non_finite, 1U) << c.what;
    EXPECT_EQ(result.pixels_over, 1U) << c.what;
    EXPECT_FALSE(result.agrees()) << c.what;
    EXPECT_FALSE(comparison::is_within(pixel_of(c.reference).pixel(0, 0), pixel_of(c.test).pixel(0, 0), 1e30))
        << c.what;
    EXPECT_EQ(comparison::pixels_over(pixel_of(c.reference), pixel_of(c.test), 1e30).size(), 1U) << c.what;
  }
}

TEST(Comparison, WhatIsNotFiniteEntersNoMean) {
  const Image reference = image_of(3, 1, {0, 0, 0, nan, 0.5F, 0.5F, 0, 0, 0});
  const Image test = image_of(3, 1, {0.5F, 0, 0, 0.5F, 9, 9, infinity, 5, 5});
  const Comparison c = compare(reference, test, 0.75);
  EXPECT_EQ(c.non_finite, 2U);
  EXPECT_EQ(c.pixels_over, 2U);
  EXPECT_DOUBLE_EQ(c.max_error, 0.5);
  EXPECT_DOUBLE_EQ(c.mean_error, 0.5 / 3);
  EXPECT_DOUBLE_EQ(c.rms_error, std::sqrt(0.25 / 3));
  EXPECT_EQ(c.worst.x, 1) << "the first that is not finite";
}

TEST(Comparison, NothingFiniteAtAllGivesFiniteMeans) {
  const Comparison c = compare(image_of(1, 1, {nan, nan, nan}), image_of(1, 1, {0, 0, 0}), 1);
  EXPECT_EQ(c.mean_error, 0);
  EXPECT_EQ(c.rms_error, 0);
  EXPECT_EQ(c.max_error, 0);
  EXPECT_FALSE(c.agrees());
}

TEST(Comparison, TheToleranceIsRelativeAboveOne) {
  const double tolerance = 0.125;
  EXPECT_TRUE(compare(pixel_of(8), pixel_of(9), tolerance).agrees());
  EXPECT_FALSE(compare(pixel_of(8), pixel_of(std::nextafter(9.0F, 10.0F)), tolerance).agrees());
  EXPECT_TRUE(compare(pixel_of(-8), pixel_of(-9), tolerance).agrees());
  EXPECT_FALSE(compare(pixel_of(0.25F), pixel_of(0.5F), tolerance).agrees()) << "absolute below 1";
}

TEST(Comparison, TheToleranceIsRelativeToTheReferenceNotToOurPicture) {
  EXPECT_TRUE(compare(pixel_of(8), pixel_of(10), 0.25).agrees());
  EXPECT_FALSE(compare(pixel_of(8), pixel_of(10.5F), 0.25).agrees())
      << "2.5 is within a quarter of 10.5 only";
  EXPECT_TRUE(compare(pixel_of(10.5F), pixel_of(8), 0.25).agrees());
}

TEST(Comparison, OneUnitInTheLastPlaceBeyondTheToleranceFails) {
  const double tolerance = 0.125;
  const float at = 0.5F + 0.125F;
  const float beyond = std::nextafter(at, 1.0F);
  EXPECT_TRUE(compare(pixel_of(0.5F), pixel_of(at), tolerance).agrees());
  EXPECT_FALSE(compare(pixel_of(0.5F), pixel_of(beyond), tolerance).agrees());
  EXPECT_FALSE(compare(pixel_of(0.5F), pixel_of(std::nextafter(0.5F, 1.0F)), 0).agrees());
  EXPECT_TRUE(compare(pixel_of(1), pixel_of(std::nextafter(1.0F, 2.0F)), 1e-6).agrees());
  EXPECT_FALSE(compare(pixel_of(1), pixel_of(std::nextafter(1.0F, 2.0F)), 1e-7).agrees());
}

TEST(Comparison, AnyComponentMayDiffer) {
  for (std::size_t i = 0; i < 12; ++i) {
    const Image reference = image_of(2, 2, std::vector<float>(12, 0.5F));
    Image test = reference;
    test.rgb[i] += 0.01F;
    const Comparison c = compare(reference, test, 1e-6);
    EXPECT_EQ(c.pixels_over, 1U) << i;
    const auto places = comparison::pixels_over(reference, test, 1e-6);
    ASSERT_EQ(places.size(), 1U) << i;
    EXPECT_EQ(static_cast<std::size_t>(places[0].y * 2 + places[0].x), i / 3);
  }
}

TEST(Comparison, PlacesAreToldRowByRow) {
  const Image reference(3, 2);
  Image test(3, 2);
  for (const auto& [x, y] : {std::pair{2, 0}, {0, 1}, {1, 1}}) test.pixel(x, y)[2] = 1;
  const auto places = comparison::pixels_over(reference, test, 0.5);
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ((std::pair{places[0].x, places[0].y}), (std::pair{2, 0}));
  EXPECT_EQ((std::pair{places[1].x, places[1].y}), (std::pair{0, 1}));
  EXPECT_EQ((std::pair{places[2].x, places[2].y}), (std::pair{1, 1}));
}

TEST(Comparison, OtherChannelCountsAreCompared) {
  const Comparison c = compare(2, 1, 1, {0, 0.5F}, {0, 1}, 0.25);
  EXPECT_EQ(c.pixels, 2U);
  EXPECT_EQ(c.pixels_over, 1U);
  EXPECT_EQ(c.worst.test, std::vector<float>{1});
}

TEST(Comparison, DifferentSizesAreRefusedAndTold) {
  for (const auto& [width, height] : {std::pair{2, 3}, {3, 2}, {3, 3}, {6, 1}}) {
    try {
      compare(Image(width, height), Image(2, 2), 1);
      ADD_FAILURE() << width << " x " << height << " was compared with 2 x 2";
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("2 x 2"), std::string::npos) << message;
      EXPECT_NE(message.find(std::to_string(width) + " x " + std::to_string(height)), std::string::npos)
          << message;
    }
  }
}

TEST(Comparison, DifferentChannelCountsAreRefused) {
  EXPECT_THROW(compare(1, 1, 3, {0, 0, 0}, {0, 0, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(compare(1, 1, 3, {0, 0, 0, 0}, {0, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(compare(1, 1, 4, {0, 0, 0}, {0, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(compare(1, 1, 3, {}, {}, 1), std::invalid_argument);
}

TEST(Comparison, AToleranceThatIsNegativeOrNotFiniteIsRefused) {
  const Image image(1, 1);
  for (const double tolerance :
       {-1e-300, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(compare(image, image, tolerance), std::invalid_argument) << tolerance;
  }
}

}  // namespace
}  // namespace plumb::tests
