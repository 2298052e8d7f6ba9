// What bounds allow and what they leave out of a comparison.
#include "references/gates/bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "references/gates/bounds_file.hpp"
#include "tests/support/run.hpp"
#include "tracer/image/image_writer.hpp"
#include "tracer/image/io.hpp"

namespace plumb::tests {
namespace {

using namespace comparison;
using namespace gates;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::string complaint(const auto& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no complaint";
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

Image random_image(std::mt19937& random, int width, int height) {
  Image image(width, height);
  std::uniform_real_distribution<float> value(-2, 4);
  for (float& v : image.rgb) v = value(random);
  return image;
}

/// Mostly the reference, here and there something else, sometimes not finite.
Image damaged(std::mt19937& random, const Image& reference) {
  Image image = reference;
  for (float& v : image.rgb) {
    const auto kind = random() % 40;
    if (kind < 6) v += 1e-4F * static_cast<float>(kind) * v;
    if (kind == 7) v = static_cast<float>(random() % 3);
    if (kind == 8 && random() % 4 == 0) v = nan;
  }
  return image;
}

Image crop(const Image& image, const Window& w) {
  Image part(w.width, w.height);
  for (int y = 0; y < w.height; ++y)
    for (int x = 0; x < w.width; ++x) std::copy_n(image.pixel(w.x + x, w.y + y), 3, part.pixel(x, y));
  return part;
}

Region rectangle(int x, int y, int width, int height) {
  return parse_region(std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(width) + "," +
                          std::to_string(height),
                      "test");
}

// --- what is allowed ------------------------------------------------------------------------------

TEST(AllowOver, IsANumberOrAPercentage) {
  EXPECT_EQ(parse_allow_over("12", "test").of(100), 12U);
  EXPECT_EQ(parse_allow_over("0", "test").of(100), 0U);
  EXPECT_EQ(parse_allow_over("0.5%", "test").of(1000), 5U);
  EXPECT_EQ(parse_allow_over("0.5%", "test").of(999), 4U) << "part of a pixel allows no pixel";
  EXPECT_EQ(parse_allow_over("100%", "test").of(999), 999U);
  EXPECT_EQ(parse_allow_over("0.5%", "test").text(), "0.5%");
  EXPECT_EQ(parse_allow_over("12", "test").text(), "12");
}

TEST(AllowOver, WholePercentagesOfWholeNumbersAreExact) {
  for (std::size_t hundredths = 0; hundredths <= 10000; ++hundredths) {
    const AllowOver allow{static_cast<double>(hundredths) / 100, true};
    EXPECT_EQ(allow.of(100000), 10 * hundredths);
    EXPECT_EQ(allow.of(33180000), 3318 * hundredths);
  }
}

TEST(AllowOver, AnythingElseIsRefused) {
  for (const char* text :
       {"", "%", "-1", "-1%", "101%", "1.5", "nan", "inf", "1e99", "12 %x", "half", "1%%"}) {
    const std::string said = complaint([&] { parse_allow_over(text, "--allow-over"); });
    expect_parts(said, {"--allow-over: found '", "expected a number of pixels or a percentage"});
  }
}

TEST(Limit, RelativeCountsOnlyWhereItAllowsMore) {
  const Limit limit(1e-3, 0.01);
  EXPECT_DOUBLE_EQ(limit.at(0), 1e-3);
  EXPECT_DOUBLE_EQ(limit.at(0.05), 1e-3);
  EXPECT_DOUBLE_EQ(limit.at(-0.5), 5e-3);
  EXPECT_DOUBLE_EQ(limit.at(8), 0.08);
  EXPECT_DOUBLE_EQ(Limit(0.1, 0.01).at(8), 0.8) << "the tolerance is relative above 1";
}

/// All widths of vectors and their rests.
TEST(Limit, CountsAsOnePixelAfterTheOther) {
  std::mt19937 random(3);
  for (int width = 1; width <= 40; ++width) {
    const Image reference = random_image(random, width, 3), test = damaged(random, reference);
    for (const Limit limit : {Limit(0), Limit(1e-4), Limit(0, 1e-4), Limit(1e-5, 3e-4), Limit(1e-3, 1e-4)}) {
      const Comparison c = compare(reference, test, limit);
      EXPECT_EQ(c.pixels_over, pixels_over(reference, test, limit).size());
      const bool is_worst_over = !is_within(c.worst.reference.data(), c.worst.test.data(), limit);
      EXPECT_EQ(is_worst_over, c.pixels_over > 0) << "the worst pixel is over when any is";
    }
  }
}

TEST(Limit, NegativeOnesAreRefused) {
  const Image image(1, 1);
  EXPECT_THROW(compare(image, image, Limit(0, -1)), std::invalid_argument);
  EXPECT_THROW(compare(image, image, Limit(0, nan)), std::invalid_argument);
}

TEST(Bounds, SoManyPixelsMayBeOver) {
  const Image reference(10, 10);
  Image test = reference;
  for (int x = 0; x < 3; ++x) test.pixel(x, 4)[1] = 1;
  Bounds bounds;
  EXPECT_FALSE(compare_within(reference, test, bounds).agrees());
  bounds.allow_over = {2, false};
  EXPECT_FALSE(compare_within(reference, test, bounds).agrees());
  bounds.allow_over = {3, false};
  EXPECT_TRUE(compare_within(reference, test, bounds).agrees());
  bounds.allow_over = {2.99, true};
  EXPECT_FALSE(compare_within(reference, test, bounds).agrees());
  bounds.allow_over = {3, true};
  EXPECT_TRUE(compare_within(reference, test, bounds).agrees());
}

/// The widest bounds that can be asked for.
TEST(Bounds, WhatIsNotFiniteIsNeverAllowed) {
  for (const float bad :
       {nan, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    for (const bool is_in_both : {false, true}) {
      Image reference(9, 5), test(9, 5);
      test.pixel(8, 4)[2] = bad;
      if (is_in_both) reference.pixel(8, 4)[2] = bad;
      Bounds bounds{Limit(1e30, 1e30), {100, true}, {}, {}, "test"};
      EXPECT_FALSE(compare_within(reference, test, bounds).agrees());
      EXPECT_FALSE(compare_within(test, reference, bounds).agrees());
      bounds.only = {rectangle(8, 4, 1, 1)};
      EXPECT_FALSE(compare_within(reference, test, bounds).agrees());
      bounds.only = {rectangle(0, 0, 8, 5)};
      const BoundedComparison without = compare_within(reference, test, bounds);
      EXPECT_TRUE(without.agrees()) << "it was asked for to leave it out";
      EXPECT_EQ(without.ignored_non_finite, 1U);
      EXPECT_EQ(without.ignored, 5U);
    }
  }
}

// --- regions --------------------------------------------------------------------------------------

TEST(Regions, OnlyARectangleIsTheComparisonOfCrops) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const int width = 1 + static_cast<int>(random() % 40), height = 1 + static_cast<int>(random() % 9);
    const Image reference = random_image(random, width, height), test = damaged(random, reference);
    const int x = static_cast<int>(random()) % width, y = static_cast<int>(random()) % height;
    const Window w{std::abs(x), std::abs(y), 1 + static_cast<int>(random() % 9),
                   1 + static_cast<int>(random() % 9)};
    const Window inside{w.x, w.y, std::min(w.width, width - w.x), std::min(w.height, height - w.y)};
    Bounds bounds;
    bounds.limit = {1e-4, i % 2 == 0 ? 0 : 3e-4};
    const BoundedComparison whole = compare_within(crop(reference, inside), crop(test, inside), bounds);
    bounds.only = {rectangle(w.x, w.y, w.width, w.height)};
    const BoundedComparison part = compare_within(reference, test, bounds);
    EXPECT_EQ(part.comparison.pixels, whole.comparison.pixels);
    EXPECT_EQ(part.comparison.pixels_over, whole.comparison.pixels_over);
    EXPECT_EQ(part.comparison.non_finite, whole.comparison.non_finite);
    EXPECT_EQ(part.comparison.max_error, whole.comparison.max_error);
    EXPECT_EQ(part.comparison.judged_error, whole.comparison.judged_error);
    EXPECT_DOUBLE_EQ(part.comparison.mean_error, whole.comparison.mean_error);
    EXPECT_DOUBLE_EQ(part.comparison.rms_error, whole.comparison.rms_error);
    EXPECT_EQ(part.comparison.worst.x, whole.comparison.worst.x + inside.x);
    EXPECT_EQ(part.comparison.worst.y, whole.comparison.worst.y + inside.y);
    EXPECT_EQ(part.agrees(), whole.agrees());
  }
}

/// Whatever is asked for: pixels are counted one by one.
TEST(Regions, WhatIsIgnoredEntersNothing) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const Image reference = random_image(random, 23, 7), test = damaged(random, reference);
    Bounds bounds;
    bounds.limit = {1e-4, 0};
    bounds.ignore = {rectangle(3, 2, 5, 3), rectangle(-4, -2, 6, 4)};
    if (i % 2 == 0) bounds.only = {rectangle(0, 0, 20, 4), rectangle(10, 3, 40, 40)};
    const PixelMask mask = mask_of(bounds, 23, 7);
    const BoundedComparison c = compare_within(reference, test, bounds);
    EXPECT_EQ(c.comparison.pixels, mask.count());
    EXPECT_EQ(c.comparison.pixels + c.ignored, 23U * 7U);
    EXPECT_EQ(c.comparison.pixels_over, pixels_over(reference, test, bounds.limit, mask).size());
    EXPECT_TRUE(mask.has(c.comparison.worst.x, c.comparison.worst.y));
    EXPECT_FALSE(mask.has(0, 0) || mask.has(1, 1) || mask.has(3, 2) || mask.has(7, 4));
  }
}

TEST(Regions, TheWorstPixelCountsEvenWhenAllAgree) {
  Image reference(8, 2), test(8, 2);
  test.pixel(0, 0)[0] = 5;
  Bounds bounds;
  bounds.ignore = {rectangle(0, 0, 2, 2)};
  const BoundedComparison c = compare_within(reference, test, bounds);
  EXPECT_TRUE(c.agrees());
  EXPECT_EQ(c.comparison.worst.x, 2);
  EXPECT_EQ(c.comparison.max_error, 0);
  for (int width = 1; width < 20; ++width)
    EXPECT_EQ(compare(Image(width, 1), Image(width, 1), Limit{0}).worst.x, 0) << width;
}

TEST(Regions, NoPixelLeftIsNoAgreement) {
  const Image image(4, 4);
  Bounds bounds;
  bounds.ignore = {rectangle(0, 0, 4, 4)};
  expect_parts(complaint([&] { compare_within(image, image, bounds); }), {"leave no pixel"});
}

TEST(Regions, ARectangleOutsideOfThePictureIsRefused) {
  const Image image(4, 3);
  for (const char* text : {"4,0,1,1", "0,3,1,1", "-2,0,2,1", "0,-5,9,5", "2147483647,0,2147483647,1"}) {
    Bounds bounds;
    bounds.ignore = {parse_region(text, "test")};
    expect_parts(complaint([&] { compare_within(image, image, bounds); }), {text, "outside", "4 x 3"});
  }
}

TEST(Regions, NumbersThatAreNoRectangleAreRefused) {
  for (const char* text : {"", "1,2,3", "1,2,3,4,5", "1,2,3,0", "1,2,-3,4", "1.5,2,3,4", "1,2,3,4,", ",1,2,3",
                           "1;2;3;4", "99999999999,0,1,1", "10x10"}) {
    expect_parts(complaint([&] { parse_region(text, "--ignore"); }), {"--ignore: found '", "X,Y,W,H"});
  }
}

class Masks : public testing::Test {
 protected:
  Bounds ignoring(const std::string& name) const {
    Bounds bounds;
    bounds.ignore = {parse_region(name, "test", workplace_.directory())};
    return bounds;
  }
  void mask(const std::string& name, const Image& image) const {
    write_image(workplace_.path(name), image, Encoding::linear);
  }

  Workplace workplace_;
};

TEST_F(Masks, WhatIsNotBlackIsMeant) {
  Image shape(5, 4);
  shape.pixel(2, 1)[2] = 0.01F;
  shape.pixel(4, 3)[0] = 1;
  for (const char* name : {"mask.pfm", "mask.png", "mask.exr"}) {
    mask(name, shape);
    const PixelMask ignored = mask_of(ignoring(name), 5, 4);
    EXPECT_EQ(ignored.count(), 18U) << name;
    EXPECT_FALSE(ignored.has(2, 1) || ignored.has(4, 3)) << name;
    Bounds bounds;
    bounds.only = ignoring(name).ignore;
    const PixelMask only = mask_of(bounds, 5, 4);
    EXPECT_EQ(only.count(), 2U) << name;
    EXPECT_TRUE(only.has(2, 1) && only.has(4, 3)) << name;
  }
}

TEST_F(Masks, AnotherSizeIsRefused) {
  mask("mask.pfm", Image(5, 4));
  expect_parts(complaint([&] { mask_of(ignoring("mask.pfm"), 4, 5); }),
               {"mask.pfm", "5 x 4 pixels", "expected 4 x 5 pixels"});
}

TEST_F(Masks, ValuesThatAreNotFiniteAreRefused) {
  Image shape(5, 4);
  shape.pixel(2, 1)[2] = nan;
  mask("mask.pfm", shape);
  expect_parts(complaint([&] { mask_of(ignoring("mask.pfm"), 5, 4); }), {"mask.pfm", "(2, 1)", "not finite"});
}

TEST_F(Masks, AMissingOneIsNamed) {
  expect_parts(complaint([&] { mask_of(ignoring("mask.png"), 5, 4); }), {"mask.png"});
}

// --- bounds.json ----------------------------------------------------------------------------------

class BoundsJson : public testing::Test {
 protected:
  BoundsFile file(const std::string& text) const {
    workplace_.file(BoundsFile::file_name, text);
    return BoundsFile(workplace_.directory());
  }
  void expect_refused(const std::string& text, const std::vector<std::string>& parts) const {
    const std::string said = complaint([&] { file(text); });
    expect_parts(said, {"bounds.json"});
    expect_parts(said, parts);
  }

  Workplace workplace_;
};

TEST_F(BoundsJson, AnAbsentFileBoundsNothing) {
  const BoundsFile none(workplace_.directory());
  EXPECT_TRUE(none.bounds_of("glass", {}).are_plain());
  EXPECT_EQ(none.complaint_about_others({}), "");
}

TEST_F(BoundsJson, AnEntryReplacesWhatIsUsualAndAddsRegions) {
  const BoundsFile bounds = file(
      R"({"glass": {"allow_over": "0.5%", "tolerance": 1e-3, "relative": 0.25, "ignore": ["0,0,2,2", "m.png"],
          "only": "1,1,9,9", "because": "a clock"}, "ball": {"allow_over": 3, "because": "noise"}})");
  Bounds usual;
  usual.limit = {1e-5, 0.125};
  usual.ignore = {rectangle(7, 7, 1, 1)};
  const Bounds glass = bounds.bounds_of("glass", usual);
  EXPECT_EQ(glass.limit.tolerance, 1e-3);
  EXPECT_EQ(glass.limit.relative, 0.25);
  EXPECT_EQ(glass.allow_over.text(), "0.5%");
  ASSERT_EQ(glass.ignore.size(), 3U);
  EXPECT_EQ(glass.ignore[2].mask_path, workplace_.path("m.png"));
  EXPECT_EQ(glass.only.size(), 1U);
  EXPECT_EQ(glass.because, "a clock");
  const Bounds ball = bounds.bounds_of("ball", usual);
  EXPECT_EQ(ball.limit.tolerance, 1e-5);
  EXPECT_EQ(ball.limit.relative, 0.125);
  EXPECT_EQ(ball.allow_over.of(10), 3U);
  EXPECT_EQ(bounds.bounds_of("other", usual).because, "");
}

TEST_F(BoundsJson, WithoutAReasonNothingIsAllowed) {
  expect_refused(R"({"glass": {"allow_over": 3}})", {"'glass'", "because"});
  expect_refused(R"({"glass": {"allow_over": 3, "because": ""}})", {"'glass'", "because"});
  expect_refused(R"({"glass": {"allow_over": 3, "because": " \n"}})", {"'glass'", "because"});
  expect_refused(R"({"glass": {"allow_over": 3, "because": 7}})", {"'glass'", "because", "7"});
}

TEST_F(BoundsJson, DamageIsNamed) {
  expect_refused("", {"JSON"});
  expect_refused("[]", {"expected one whose keys are names"});
  expect_refused(R"({"glass": 3})", {"'glass'", "an object"});
  expect_refused(R"({"glass": {"alow_over": 3, "because": "x"}})", {"'glass'", "'alow_over'", "allow_over"});
  expect_refused(R"({"glass": {"allow_over": -3, "because": "x"}})", {"'glass'", "allow_over", "-3"});
  expect_refused(R"({"glass": {"allow_over": "x%", "because": "x"}})", {"'glass'", "allow_over", "'x%'"});
  expect_refused(R"({"glass": {"tolerance": "x", "because": "x"}})",
                 {"'glass'", "tolerance", "finite number"});
  expect_refused(R"({"glass": {"relative": -1, "because": "x"}})", {"'glass'", "relative", "-1"});
  expect_refused(R"({"glass": {"relative": 1e999, "because": "x"}})", {"bounds.json"});
  expect_refused(R"({"glass": {"ignore": [], "because": "x"}})", {"'glass'", "ignore", "at least one"});
  expect_refused(R"({"glass": {"only": ["1,2"], "because": "x"}})", {"'glass'", "only", "'1,2'", "X,Y,W,H"});
  expect_refused(R"({"glass": {"only": [1,2,3,4], "because": "x"}})", {"'glass'", "only", "X,Y,W,H"});
}

TEST_F(BoundsJson, NothingIsSaidTwice) {
  expect_refused(R"({"a": {"because": "x"}, "a": {"because": "y"}})", {"'a' twice"});
  expect_refused(R"({"a": {"because": "x", "tolerance": 1, "tolerance": 2}})", {"'tolerance' twice"});
}

TEST_F(BoundsJson, BoundsOfNothingAreTold) {
  const BoundsFile bounds = file(R"({"glas": {"because": "x"}})");
  EXPECT_EQ(bounds.complaint_about_others({"ball", "glas"}), "");
  expect_parts(bounds.complaint_about_others({"ball", "glass"}), {"bounds.json", "'glas'"});
}

}  // namespace
}  // namespace plumb::tests
