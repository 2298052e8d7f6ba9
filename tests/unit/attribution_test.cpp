// The pixel budget on scenes made so that the cause is known beforehand. The references are our own pictures
// of slightly other scenes, so that no renderer is needed.
#include "references/attribution/attribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "references/attribution/perturbation.hpp"
#include "references/renderers/ours.hpp"
#include "references/renderers/povray.hpp"
#include "references/report/sentences.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::tests {
namespace {

using attribution::Budget;
using attribution::Cause;

constexpr int side = 8;

// With this camera the centre of column 5 looks at x = 1.5 where z = -4, that of row 2 at y = 1.5.
const std::string head = R"(
define material wall 0.5 0.4 0.3 0.5 0.5 0.5 0 0 0 1
define material other 0.1 0.2 0.9 0.2 0.6 0.2 0 0 0 1
define material mirror 0.1 0.1 0.1 0 0 0 0 0 0 1 mirror 0.8 0.7 0.6
ambient 0.5 0.5 0.5
background 0.1 0.15 0.2
define camera eye 90
render eye image.ppm 8 8
)";
const std::string edge_along_a_column = head + "define shape box front -1 -1 -6 1.5 1 -4 wall\n";
const std::string shadow_along_a_column = head + R"(
define light key 0 6 2 1 1 1 1
define shape box back -9 -9 -5 9 9 -4 wall
define shape box blocker -1 3 -2 0.975 3.2 -1.9 other
)";
const std::string mirrored_edge = head + R"(
define shape box back -9 -9 -5 9 9 -4 mirror
define shape box behind -9 -9 4 4.5 9 5 other
)";
const std::string two_at_one_place = head + R"(
define shape box one -1.3 -0.7 -6 0.9 0.9 -4 wall
define shape box two -0.8 -0.9 -7 1.2 0.6 -4 other
)";

Scene scene_of(const std::string& text) {
  const ReadResult read = read_scene(text);
  EXPECT_FALSE(read.has_errors()) << text;
  return read.scene;
}

Image picture(const Scene& scene, const RenderOptions& options = {}, int pixels = side) {
  textbook::RenderJob job;
  job.width = pixels;
  job.height = pixels;
  job.options = options;
  return textbook::render(scene, scene.cameras.front(), job);
}

Budget budget_of(const Scene& scene, const Image& reference, const Image& test,
                 renderers::Holds holds = renderers::Holds::float32) {
  const Budget budget = attribution::attribute({{scene, scene.cameras.front(), test.width, test.height},
                                                reference,
                                                test,
                                                1e-6,
                                                renderers::povray_resolution(),
                                                holds});
  std::size_t sum = 0;
  for (std::size_t i = 0; i < attribution::cause_count; ++i) sum += budget.count(static_cast<Cause>(i));
  EXPECT_EQ(sum, comparison::pixels_over(reference, test, 1e-6).size()) << "each pixel over has one cause";
  return budget;
}

/// Moves a face of a box by 1e-9 each way; where that shows, all must have the cause.
void expect_cause(const std::string& text, std::size_t shape, int axis, Cause cause) {
  const Scene scene = scene_of(text);
  const Image test = picture(scene);
  std::size_t over = 0;
  for (const double step : {1e-9, -1e-9}) {
    Scene moved = scene;
    std::get<Box>(moved.shapes[shape].geometry).max[axis] += step;
    const Budget budget = budget_of(scene, picture(moved), test);
    EXPECT_EQ(budget.count(cause), budget.pixels.size()) << text;
    if (!budget.pixels.empty()) {
      EXPECT_FALSE(budget.shapes.empty());
    }
    over += budget.pixels.size();
  }
  EXPECT_GT(over, 0U) << "one of the two must show: " << text;
}

TEST(Attribution, AnEdgeAlongPixelCentresIsASilhouette) {
  expect_cause(edge_along_a_column, 0, 0, Cause::silhouette);
}

TEST(Attribution, TheEdgeOfAShadow) { expect_cause(shadow_along_a_column, 1, 0, Cause::shadow_edge); }

TEST(Attribution, AnEdgeInAMirror) { expect_cause(mirrored_edge, 1, 0, Cause::secondary_edge); }

TEST(Attribution, SurfacesAtOnePlace) { expect_cause(two_at_one_place, 1, 2, Cause::coincident); }

TEST(Attribution, WhatIsNearerToALightThanTheReferenceResolves) {
  const std::string without = head + R"(
define light key 0 6 2 1 1 1 1
define shape box back -9 -9 -5 9 9 -4 wall
)";
  Scene scene = scene_of(without + "define shape box near -1 5 1 1 7 1.5 other\n");
  const double extent = renderers::povray_resolution().extent(scene, scene.cameras.front());
  Box& near = std::get<Box>(scene.shapes[1].geometry);
  near.min.z = 2 - 4.5e-8 * extent;
  near.max.z = 2 - 3e-8 * extent;
  const Budget budget = budget_of(scene, picture(scene_of(without)), picture(scene));
  EXPECT_GT(budget.pixels.size(), 30U) << "without the tolerance all is dark";
  EXPECT_EQ(budget.count(Cause::reference_tolerance), budget.pixels.size());
  EXPECT_TRUE(attribution::broken_bound(budget, side, side)) << "so many are no matter of chance";
}

TEST(Attribution, OneRayMore) {
  const std::string room = mirrored_edge + "define shape box mirror2 -9 -9 6 9 9 7 mirror\n";
  const Scene scene = scene_of(room);
  RenderOptions shorter;
  shorter.depth = 7;
  Scene open = scene;  // so that rays go to and fro
  std::get<Box>(open.shapes[1].geometry) = {Vec3d(20), Vec3d(21), 1};
  const Budget budget = budget_of(open, picture(open, shorter), picture(open));
  EXPECT_GT(budget.pixels.size(), 0U);
  EXPECT_EQ(budget.count(Cause::depth), budget.pixels.size());
}

TEST(Attribution, DepthIsNoExcuseWhereItChangesNothing) {
  const Scene scene = scene_of(edge_along_a_column);
  const Image traced = picture(scene);
  Image reference = traced;
  Image test = traced;
  for (std::size_t i = 0; i < traced.rgb.size(); ++i) {
    reference.rgb[i] -= 0.9e-6F;
    test.rgb[i] += 0.9e-6F;
  }
  const Budget budget = budget_of(scene, reference, test);
  EXPECT_GT(budget.pixels.size(), 30U);
  EXPECT_EQ(budget.explained(), 0U)
      << "both are within the tolerance of what is traced, but not of each other";
}

TEST(Attribution, AVastSkyExcusesNothingSmall) {
  for (const double sky : {1e6, 1e8, 1e9}) {
    const std::string text = head + "define shape sphere sky 0 0 0 " + std::to_string(sky) +
                             " wall\ndefine shape sphere ball 0.1 0 -10 3 other\n";
    const Scene scene = scene_of(text);
    Scene moved = scene;
    std::get<Sphere>(moved.shapes[1].geometry).radius *= 1.3;
    for (const bool is_ours : {false, true}) {
      const Image reference = picture(moved);
      const Image test = picture(scene);
      const Budget budget =
          attribution::attribute({{scene, scene.cameras.front(), test.width, test.height},
                                  reference,
                                  test,
                                  1e-6,
                                  is_ours ? renderers::own_resolution() : renderers::povray_resolution()});
      EXPECT_GT(budget.pixels.size(), 0U);
      EXPECT_EQ(budget.explained(), 0U) << sky;
    }
  }
}

TEST(Attribution, AgainstABaselineNothingOfPovraysIsExcused) {
  const Scene scene = scene_of(mirrored_edge);
  RenderOptions shallow;
  shallow.depth = 1;
  const Image reference = picture(scene, shallow);
  const Image test = picture(scene);
  const Budget budget = attribution::attribute({{scene, scene.cameras.front(), test.width, test.height},
                                                reference,
                                                test,
                                                1e-6,
                                                renderers::own_resolution()});
  EXPECT_GT(budget.pixels.size(), 0U);
  EXPECT_EQ(budget.explained(), 0U);
}

TEST(Attribution, RoundingAndClampingOfIntegers) {
  const Scene scene = scene_of(head + R"(
define light key 0 0 2 1 1 1 1.7
define light dim 3 3 0 1 1 1 0.1
define shape box back -9 -9 -5 9 9 -4 wall
define shape sphere ball 1 0 -4 0.5 other
)");
  const Image test = picture(scene);
  Image reference = test;
  for (float& v : reference.rgb) v = std::round(std::clamp(v, 0.0F, 1.0F) * 255) / 255;
  const Budget budget = budget_of(scene, reference, test, renderers::Holds::bits8);
  EXPECT_EQ(budget.count(Cause::unexplained), 0U);
  EXPECT_GT(budget.count(Cause::clamped), 0U);
  EXPECT_GT(budget.count(Cause::quantisation), 0U);
  reference.rgb[0] += 2.0F / 255;
  EXPECT_EQ(budget_of(scene, reference, test, renderers::Holds::bits8).count(Cause::unexplained), 1U);
  EXPECT_GT(budget_of(scene, reference, test).count(Cause::unexplained), 30U)
      << "a reference of floats has no such excuse";
}

/// Mirrors that transmit double the rays with each level: the pictures are none of the scene's, for it is
/// never rendered.
/// The reference holds 1 whatever is brighter: it cannot tell that the test is wrong, but tracing can.
TEST(Attribution, ABrighterValueThanIsTracedIsNotClamped) {
  const Scene scene = scene_of(head + R"(
define light key 0 0 2 1 1 1 4
define shape box back -9 -9 -5 9 9 -4 wall
)");
  const Image right = picture(scene);
  Image reference = right;
  for (float& v : reference.rgb) v = std::round(std::clamp(v, 0.0F, 1.0F) * 255) / 255;
  const auto clamped = [&](const Image& test) {
    return budget_of(scene, reference, test, renderers::Holds::bits8).count(Cause::clamped);
  };
  const std::size_t all = clamped(right);
  ASSERT_GT(all, 3U);
  Image wrong = right;
  for (int y = 0; y < side; ++y) {
    for (int c = 0; c < 3; ++c) wrong.pixel(3, y)[c] += wrong.pixel(3, y)[c] > 1 ? 0.01F : 0.0F;
  }
  EXPECT_LT(clamped(wrong), all);
  EXPECT_EQ(budget_of(scene, reference, wrong, renderers::Holds::bits8).count(Cause::unexplained),
            all - clamped(wrong));
}

TEST(Attribution, APixelOfTooManyRaysIsUnexplained) {
  const Scene scene = scene_of(head + R"(
define material both 0.1 0.1 0.1 0 0 0 0 0 0 1 mirror 0.5 0.5 0.5 transmit 0.5 0.5 0.5 eta 1.1
define shape sphere outer 0 0 -5 3 both
define shape sphere inner 0 0 -5 2 both
)");
  RenderOptions deep;
  deep.depth = 256;
  const Image reference = picture(scene);
  Image test = reference;
  for (float& v : test.rgb) v += 0.1F;
  const Budget budget = attribution::attribute({{scene, scene.cameras.front(), test.width, test.height, deep},
                                                reference,
                                                test,
                                                1e-6,
                                                renderers::povray_resolution()});
  EXPECT_EQ(budget.count(Cause::unexplained), static_cast<std::size_t>(side * side));
}

TEST(Attribution, WhatIsNotFiniteIsNeverExplained) {
  const Scene scene = scene_of(edge_along_a_column);
  Image reference = picture(scene);
  reference.pixel(5, 3)[1] = std::numeric_limits<float>::quiet_NaN();
  reference.pixel(1, 1)[0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(budget_of(scene, reference, picture(scene)).count(Cause::unexplained), 2U);
}

TEST(Attribution, AnotherModelIsUnexplained) {
  for (const std::string& text :
       {edge_along_a_column, shadow_along_a_column, mirrored_edge, two_at_one_place}) {
    const Scene scene = scene_of(text);
    for (const double factor : {0.99, 0.9999, 1.001}) {
      Scene wrong = scene;
      for (Material& m : wrong.materials) m.ka *= factor;
      const Image right = picture(scene);
      const Budget as_reference = budget_of(scene, picture(wrong), right);
      const Budget as_test = budget_of(scene, right, picture(wrong));
      EXPECT_GT(as_reference.pixels.size(), 0U);
      EXPECT_EQ(as_reference.explained(), 0U) << text << factor;
      EXPECT_EQ(as_test.explained(), 0U) << "a wrong test picture against a right reference: " << text;
    }
  }
}

constexpr int large_side = 64;

TEST(Attribution, OfAPictureThatDiffersAsAWholeASampleIsExamined) {
  const Scene scene = scene_of(edge_along_a_column);
  Scene wrong = scene;
  wrong.background *= 1.001;
  for (Material& m : wrong.materials) m.ka *= 1.001;
  const Budget budget = budget_of(scene, picture(scene, {}, large_side), picture(wrong, {}, large_side));
  const std::size_t all = large_side * large_side;
  EXPECT_EQ(budget.count(Cause::unexplained), all);
  EXPECT_EQ(budget.unexamined, all - 256);
  EXPECT_NE(report::note_of(budget), "");
}

TEST(Attribution, AllAreExaminedWhenTheSampleIsExplained) {
  const Scene scene = scene_of(head +
                               "define shape box one -19 -19 -6 19 19 -4 wall\n"
                               "define shape box two -19 -19 -7 19 19 -4 other\n");
  Scene moved = scene;
  std::get<Box>(moved.shapes[1].geometry).max.z += 1e-9;
  Scene back = scene;
  std::get<Box>(back.shapes[1].geometry).max.z -= 1e-9;
  const Budget budget = budget_of(scene, picture(moved, {}, large_side), picture(back, {}, large_side));
  EXPECT_EQ(budget.count(Cause::coincident), static_cast<std::size_t>(large_side * large_side));
  EXPECT_EQ(budget.unexamined, 0U);
  EXPECT_EQ(report::note_of(budget), "");
}

TEST(Attribution, WhatIsLeftWhenTheWorkIsOverIsUnexamined) {
  const Scene scene = scene_of(two_at_one_place);
  Scene moved = scene;
  std::get<Box>(moved.shapes[1].geometry).max.z += 1e-9;
  const Image reference = picture(moved);
  const Image test = picture(scene);
  attribution::AttributionJob job{{scene, scene.cameras.front(), test.width, test.height},
                                  reference,
                                  test,
                                  1e-6,
                                  renderers::povray_resolution()};
  const Budget whole = attribution::attribute(job);
  ASSERT_EQ(whole.count(Cause::coincident), whole.pixels.size());
  EXPECT_EQ(whole.unexamined, 0U);
  job.work = 100;  // a few rays
  const Budget begun = attribution::attribute(job);
  EXPECT_EQ(begun.pixels.size(), whole.pixels.size());
  EXPECT_EQ(begun.unexamined, begun.count(Cause::unexplained));
  EXPECT_GT(begun.unexamined, 0U);
  EXPECT_NE(report::note_of(begun), "");
}

TEST(Attribution, BoundsHoldForFewAndBreakForMany) {
  Budget budget;
  for (int i = 0; i < 20; ++i) budget.pixels.push_back({0, i, Cause::silhouette});
  EXPECT_TRUE(attribution::broken_bound(budget, side, side)) << "16 and 5 % of 64";
  budget.pixels.pop_back();
  EXPECT_FALSE(attribution::broken_bound(budget, side, side));
}

TEST(Attribution, MoreThanAHundredthOfThePictureUnverifiedBreaksTheBound) {
  for (const Cause cause : {Cause::coincident, Cause::reference_tolerance}) {
    Budget budget;
    for (int i = 0; i < 6; ++i) budget.pixels.push_back({0, i, cause});
    budget.pixels.push_back({9, 9, Cause::silhouette});
    EXPECT_EQ(budget.unverified(), 6U);
    EXPECT_FALSE(attribution::broken_bound(budget, 20, 30)) << "6 of 600";
    EXPECT_TRUE(attribution::broken_bound(budget, 20, 29)) << "6 of 580";
    budget.pixels.back().cause = Cause::coincident;
    EXPECT_NE(report::in_words(*attribution::broken_bound(budget, 20, 30)).find("7 pixels are unverified"),
              std::string::npos)
        << "both causes count together";
  }
}

}  // namespace
}  // namespace plumb::tests
