// The figures beside the verdict, against sums done by hand.
#include "references/comparison/metrics/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "references/comparison/metrics/ssim.hpp"

namespace plumb::tests {
namespace {

using comparison::cheap_metrics;
using comparison::ColourSpace;
using comparison::Metrics;
using comparison::PictureView;

using Values = std::vector<float>;

Metrics metrics_of(int channels, const Values& reference, const Values& test) {
  const int width = static_cast<int>(reference.size()) / channels;
  return cheap_metrics({width, 1, channels, reference.data()}, {width, 1, channels, test.data()});
}

TEST(Metrics, BiasIsSignedAndPerChannel) {
  const Metrics m = metrics_of(3, {0, 0, 0, 0, 0, 0}, {0.5F, -0.25F, 0, 0.25F, -0.25F, 0});
  EXPECT_EQ(m.bias, (std::vector<double>{0.375, -0.25, 0}));
}

TEST(Metrics, PsnrIsThatOfThePeak) {
  // RMS 0.1 with a peak of 1 is 20 dB; with a peak of 10 it is 40 dB.
  EXPECT_NEAR(metrics_of(1, {0, 0.5F}, {0.1F, 0.4F}).psnr_db.value(), 20, 1e-4);
  EXPECT_NEAR(metrics_of(1, {10, 0.5F}, {9.9F, 0.4F}).psnr_db.value(), 40, 1e-4);
  EXPECT_EQ(metrics_of(1, {10, 0.5F}, {9.9F, 0.4F}).peak, 10);
}

TEST(Metrics, EqualPicturesHaveNoPsnr) {
  const Metrics m = metrics_of(1, {0, 1, 2}, {0, 1, 2});
  EXPECT_FALSE(m.psnr_db.has_value());
  for (const double p : m.percentiles) EXPECT_EQ(p, 0);
}

TEST(Metrics, PercentilesAreNearestRanksOfTheLargestDifferenceOfAPixel) {
  Values reference(2000), test(2000);  // two channels; the differences are 1 to 1000, backwards
  for (std::size_t i = 0; i < 1000; ++i) test[2 * i + i % 2] = static_cast<float>(1000 - i);
  const Metrics m = metrics_of(2, reference, test);
  EXPECT_EQ(m.percentiles[0], 500);
  EXPECT_EQ(m.percentiles[1], 900);
  EXPECT_EQ(m.percentiles[2], 990);
  EXPECT_EQ(m.percentiles[3], 999);
}

TEST(Metrics, PercentilesAreNotRounded) {
  // 1 - 2^-30 has more bits than a float.
  const Metrics m = metrics_of(1, {std::ldexp(1.0F, -30)}, {1});
  EXPECT_EQ(m.percentiles[0], 1 - std::ldexp(1.0, -30));
}

TEST(Metrics, WhatIsNotFiniteEntersNoFigure) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Metrics m = metrics_of(1, {0, nan, 0, -infinity}, {0.5F, 9, infinity, infinity});
  EXPECT_EQ(m.bias[0], 0.5);
  EXPECT_EQ(m.percentiles[3], 0.5);
  EXPECT_EQ(m.peak, 1);
  const Values a{0, nan}, b{0, 0};
  const Metrics all = comparison::all_metrics({2, 1, 1, a.data()}, {2, 1, 1, b.data()}, ColourSpace::linear);
  EXPECT_FALSE(all.scalars.empty());
  for (const auto& scalar : all.scalars) EXPECT_FALSE(scalar.has_value());
  EXPECT_FALSE(all.flip.has_value());
}

TEST(Metrics, NothingFiniteGivesFiniteFigures) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Metrics m = metrics_of(1, {nan}, {nan});
  EXPECT_EQ(m.bias[0], 0);
  EXPECT_FALSE(m.psnr_db.has_value());
}

// --- SSIM --------------------------------------------------------------------------------------------

std::optional<double> ssim_of(int width, int height, const Values& reference, const Values& test) {
  return comparison::ssim({width, height, 1, reference.data()}, {width, height, 1, test.data()}, 1);
}

TEST(Ssim, EqualPicturesGiveOne) {
  Values p(20 * 15);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = static_cast<float>(i * 7919 % 101) / 100;
  EXPECT_NEAR(ssim_of(20, 15, p, p).value(), 1, 1e-12);
}

TEST(Ssim, UniformPicturesGiveTheirLuminanceTerm) {
  // (2 x y + C1) / (x^2 + y^2 + C1), C1 = 0.01^2; the other term is C2 / C2.
  const double expected = (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4);
  EXPECT_NEAR(ssim_of(12, 11, Values(132, 0.25F), Values(132, 0.75F)).value(), expected, 1e-12);
}

TEST(Ssim, OneWindowIsThatDoneByPlainSums) {
  Values x(121), y(121);
  double sum = 0, mx = 0, my = 0, vx = 0, vy = 0, cov = 0;
  const auto weight = [](std::size_t i) {
    const double u = static_cast<double>(i % 11) - 5, v = static_cast<double>(i / 11) - 5;
    return std::exp(-(u * u + v * v) / 4.5);
  };
  for (std::size_t i = 0; i < 121; ++i) {
    x[i] = static_cast<float>(i * 37 % 64) / 64;
    y[i] = static_cast<float>(i * 53 % 64) / 64;
    sum += weight(i);
    mx += weight(i) * x[i];
    my += weight(i) * y[i];
  }
  mx /= sum;
  my /= sum;
  for (std::size_t i = 0; i < 121; ++i) {
    vx += weight(i) / sum * (x[i] - mx) * (x[i] - mx);
    vy += weight(i) / sum * (y[i] - my) * (y[i] - my);
    cov += weight(i) / sum * (x[i] - mx) * (y[i] - my);
  }
  const double expected =
      (2 * mx * my + 1e-4) * (2 * cov + 9e-4) / ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4));
  EXPECT_NEAR(ssim_of(11, 11, x, y).value(), expected, 1e-12);
}

TEST(Ssim, APictureSmallerThanTheWindowHasNone) {
  EXPECT_FALSE(ssim_of(10, 20, Values(200), Values(200)).has_value());
  EXPECT_FALSE(ssim_of(20, 10, Values(200), Values(200)).has_value());
}

}  // namespace
}  // namespace plumb::tests
