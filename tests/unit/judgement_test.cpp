// Who is wrong, in pictures of which it is known.
#include "references/truth/judgement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "references/renderers/ours.hpp"
#include "references/renderers/povray.hpp"
#include "references/report/sentences.hpp"
#include "tests/support/run.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

/// Of one value.
Image plain(int width, int height, float value) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), value);
  return image;
}

class JudgedPictures : public testing::Test {
 protected:
  JudgedPictures()
      : scene_(read_scene(read_file(tests::source_path("tests/scenes/phong.sdf"))).scene),
        right_(engine::render(scene_, scene_.cameras.front(), small_job())) {}

  static RenderJob small_job() {
    RenderJob job;
    job.width = 32;
    job.height = 24;
    return job;
  }

  Image wrong_at(int x, int y) const {
    Image image = right_;
    image.pixel(x, y)[1] += 0.01F;
    return image;
  }

  truth::Judgement judged(const Image& reference, const Image& ours) const {
    return truth::judge_pixels({{scene_, scene_.cameras.front(), ours.width, ours.height, options_},
                                reference,
                                ours,
                                1e-6,
                                renderers::povray_resolution()});
  }

  Scene scene_;
  RenderOptions options_;
  Image right_;
};

TEST_F(JudgedPictures, NothingIsJudgedWhereTheyAgree) { EXPECT_TRUE(judged(right_, right_).pixels.empty()); }

TEST_F(JudgedPictures, NothingExplainsAPixelAtWhichOursIsWrong) {
  const auto budget_beside = [](truth::Verdict verdict,
                                attribution::Cause cause = attribution::Cause::silhouette) {
    truth::Judgement judgement;
    judgement.pixels.push_back({3, 4, verdict, {}, {}, {}});
    attribution::Budget budget;
    budget.pixels = {
        {2, 4, attribution::Cause::silhouette}, {3, 4, cause}, {4, 3, attribution::Cause::silhouette}};
    truth::reconcile(judgement, budget);
    EXPECT_EQ(budget.pixels[0].cause, attribution::Cause::silhouette) << "another pixel";
    EXPECT_EQ(budget.pixels[2].cause, attribution::Cause::silhouette) << "another pixel";
    return budget.pixels[1].cause;
  };
  EXPECT_EQ(budget_beside(truth::Verdict::ours_wrong), attribution::Cause::unexplained);
  EXPECT_EQ(budget_beside(truth::Verdict::both_wrong), attribution::Cause::unexplained);
  EXPECT_EQ(budget_beside(truth::Verdict::reference_wrong), attribution::Cause::silhouette);
  EXPECT_EQ(budget_beside(truth::Verdict::undecided), attribution::Cause::silhouette);
  EXPECT_EQ(budget_beside(truth::Verdict::undecided, attribution::Cause::unexplained),
            attribution::Cause::undecided);
  EXPECT_EQ(budget_beside(truth::Verdict::reference_wrong, attribution::Cause::unexplained),
            attribution::Cause::unexplained);
}

TEST_F(JudgedPictures, TheWrongSideIsNamed) {
  const truth::Judgement ours = judged(right_, wrong_at(3, 4));
  ASSERT_EQ(ours.pixels.size(), 1U);
  EXPECT_EQ(ours.pixels[0].verdict, truth::Verdict::ours_wrong);
  EXPECT_EQ(ours.pixels[0].x, 3);
  EXPECT_EQ(ours.pixels[0].y, 4);
  const truth::Judgement reference = judged(wrong_at(3, 4), right_);
  ASSERT_EQ(reference.pixels.size(), 1U);
  EXPECT_EQ(reference.pixels[0].verdict, truth::Verdict::reference_wrong);
}

/// A ray that passes by the glass that it starts in, and then takes leaving it for entering, is no rounding.
TEST(JudgedGlass, AnInvertedRefractionIsWrongWhereTheEyeLiesOnGlass) {
  const Scene scene = read_scene(
                          "define material green 0 0.9 0 0 0.5 0 0 0 0 1\n"
                          "define material glass 0 0 0.1 0 0 0.3 0 0 0 1 transmit 0.6 0.6 0.6 eta 1.5\n"
                          "define shape sphere ball 0.5 0.5 -0.25 0.375 glass\n"
                          "define shape box wall -9 -9 -9 9 9 -5 green\n"
                          "define light l 5 4 3 1 1 1 1\nambient 0.5 0.5 0.5\nbackground 0.1 0.2 0.7\n"
                          "define camera eye 90 0.5 0.125 -0.25 0 0.1 -1 0 0 1\n")
                          .scene;
  RenderJob job;
  job.width = 32;
  job.height = 24;
  const Image right = engine::render(scene, scene.cameras.front(), job);
  Image inverted = right;
  const float value[] = {0, 0.459F,
                         0.05F};  // bent by 1/1.5 where the ray leaves: the wall in place of a mirror
  std::copy(std::begin(value), std::end(value), inverted.pixel(0, 0));
  const truth::Judgement judged =
      truth::judge_pixels({{scene, scene.cameras.front(), right.width, right.height},
                           inverted,
                           right,
                           1e-6,
                           renderers::povray_resolution()});
  ASSERT_EQ(judged.pixels.size(), 1U);
  EXPECT_EQ(judged.pixels[0].verdict, truth::Verdict::reference_wrong);
}

TEST_F(JudgedPictures, BothMayBeWrong) {
  Image darker = right_;
  darker.pixel(3, 4)[1] -= 0.01F;
  EXPECT_EQ(judged(darker, wrong_at(3, 4)).count(truth::Verdict::both_wrong), 1U);
}

TEST_F(JudgedPictures, TwoValuesOnEitherSideOfTheRightOneAreUndecided) {
  Image lower = right_;
  Image higher = right_;
  lower.pixel(3, 4)[1] -= 0.7e-6F;
  higher.pixel(3, 4)[1] += 0.7e-6F;
  EXPECT_EQ(judged(lower, higher).count(truth::Verdict::undecided), 1U);
}

TEST_F(JudgedPictures, WhatIsNotJudgedIsCounted) {
  const attribution::AttributionJob job{
      {scene_, scene_.cameras.front(), right_.width, right_.height, options_},
      right_,
      wrong_at(3, 4),
      1e-6,
      renderers::povray_resolution()};
  const truth::Judgement judgement = truth::judge_pixels(job, 0);
  EXPECT_EQ(judgement.not_judged, 1U);
  EXPECT_TRUE(judgement.ran_out);
  EXPECT_FALSE(report::note_of(judgement).empty());
}

TEST_F(JudgedPictures, WhatIsNotFiniteIsWrong) {
  Image ours = right_;
  ours.pixel(3, 4)[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(judged(right_, ours).count(truth::Verdict::ours_wrong), 1U);
}

TEST_F(JudgedPictures, TheToleranceIsRelativeAboveOne) {
  const Scene bright = read_scene("background 4 4 4\n").scene;
  const auto verdicts = [&](float by) {
    Image reference = plain(2, 1, 4);
    Image ours = reference;
    reference.pixel(1, 0)[0] -= 3.5e-6F;  // within 4e-6 of 4
    ours.pixel(1, 0)[0] += by;
    return truth::judge_pixels({{bright, bright.cameras.front(), ours.width, ours.height, options_},
                                reference,
                                ours,
                                1e-6,
                                renderers::povray_resolution()});
  };
  EXPECT_EQ(verdicts(3.5e-6F).count(truth::Verdict::undecided), 1U);
  EXPECT_EQ(verdicts(6e-6F).count(truth::Verdict::ours_wrong), 1U);
}

/// Seen under 90 degrees from the origin, so that the ray of a pixel is known by heart; all glows.
Scene glowing(const std::string& shape) {
  const ReadResult read = read_scene("define material glow 0.5 0.5 0.5 0 0 0 0 0 0 1\nambient 1 1 1\n" +
                                     shape + "\ndefine camera eye 90\n");
  EXPECT_FALSE(read.has_errors());
  return read.scene;
}

/// What is said of the pixel when one side sees the shape there and the other one does not, either way round.
void expect_open(const Scene& scene, int side, int x, int y) {
  Image sees = plain(side, side, 0);
  Image misses = sees;
  for (int c = 0; c < 3; ++c) sees.pixel(x, y)[c] = 0.5F;
  for (const bool ours_sees : {true, false}) {
    const truth::Judgement judgement =
        truth::judge_pixels({{scene, scene.cameras.front(), sees.width, sees.height},
                             ours_sees ? misses : sees,
                             ours_sees ? sees : misses,
                             1e-6,
                             renderers::povray_resolution()});
    ASSERT_EQ(judgement.pixels.size(), 1U);
    EXPECT_EQ(judgement.pixels[0].verdict, truth::Verdict::undecided);
  }
}

TEST(Judgement, ASampleOnAnEdgeIsUndecided) {
  // The centre of column 5 of 8 looks at x = 1.5 where z = -4.
  expect_open(glowing("define shape box front -1 -1 -6 1.5 1 -4 glow"), 8, 5, 3);
}

TEST(Judgement, ATangentIsUndecided) {
  expect_open(glowing("define shape sphere ball 2 0 -4 2 glow"), 9, 4, 4);
}

TEST(Judgement, WhatNoEdgeExplainsIsWrongThere) {
  // On the edge the scene allows what lies between shape and background, and nothing brighter.
  const Scene scene = glowing("define shape box front -1 -1 -6 1.5 1 -4 glow");
  const Image shape = plain(8, 8, 0.5F);
  Image brighter = shape;
  brighter.pixel(5, 3)[0] = 0.6F;
  const truth::Judgement judgement =
      truth::judge_pixels({{scene, scene.cameras.front(), shape.width, shape.height},
                           shape,
                           brighter,
                           1e-6,
                           renderers::povray_resolution()});
  ASSERT_EQ(judgement.pixels.size(), 1U);
  EXPECT_EQ(judgement.pixels[0].verdict, truth::Verdict::ours_wrong);
}

/// Sixteen pixels a side, a pixel beside the edge of a box, of which one side sees the box and the other one
/// does not; what the budget says of it when no other proof was found.
class OnePixelWithoutACause : public testing::Test {
 protected:
  static constexpr int on_edge = 11;  // its centre looks at x = 1.75 where z = -4
  static constexpr int beside = 12;

  static attribution::Cause settled(
      const Image& reference, const Image& ours, int x,
      const renderers::Resolution& resolution = renderers::povray_resolution()) {
    const Scene scene = glowing("define shape box front -1 -1 -6 1.75 1 -4 glow");
    const attribution::AttributionJob job{
        {scene, scene.cameras.front(), ours.width, ours.height}, reference, ours, 1e-6, resolution};
    attribution::Budget budget;
    budget.pixels = {{x, 8, attribution::Cause::unexplained}};
    truth::settle_undecided(job, budget);
    return budget.pixels.front().cause;
  }
  static Image with(float value, int x) {
    Image image = plain(16, 16, 0);
    std::fill_n(image.pixel(x, 8), 3, value);
    return image;
  }
};

TEST_F(OnePixelWithoutACause, IsUndecidedWhereTheLastDigitsLeadToBothValues) {
  EXPECT_EQ(settled(with(0.5F, on_edge), with(0, on_edge), on_edge), attribution::Cause::undecided);
  EXPECT_EQ(settled(with(0, on_edge), with(0.5F, on_edge), on_edge), attribution::Cause::undecided);
}

TEST_F(OnePixelWithoutACause, IsUnexplainedWhereOneOfThemIsWrong) {
  EXPECT_EQ(settled(with(0.5F, beside), with(0, beside), beside), attribution::Cause::unexplained);
  EXPECT_EQ(settled(with(0, on_edge), with(0.6F, on_edge), on_edge), attribution::Cause::unexplained);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(settled(with(0, on_edge), with(nan, on_edge), on_edge), attribution::Cause::unexplained);
}

TEST_F(OnePixelWithoutACause, IsUnexplainedWhereTheSceneHasOneAnswerBetweenThem) {
  EXPECT_EQ(settled(with(0.7e-6F, beside), with(-0.7e-6F, beside), beside), attribution::Cause::unexplained);
}

TEST_F(OnePixelWithoutACause, IsUnexplainedAgainstABaseline) {
  EXPECT_EQ(settled(with(0.5F, on_edge), with(0, on_edge), on_edge, renderers::own_resolution()),
            attribution::Cause::unexplained);
}

TEST_F(OnePixelWithoutACause, IsUnexplainedAmongMoreThanMayBeUnverified) {
  const Scene scene = glowing("define shape box front -1 -1 -6 1.75 1 -4 glow");
  const Image reference = with(0.5F, on_edge);
  const Image ours = with(0, on_edge);
  attribution::Budget budget;
  for (int i = 0; i < 3; ++i) budget.pixels.push_back({on_edge, 8, attribution::Cause::unexplained});
  truth::settle_undecided({{scene, scene.cameras.front(), ours.width, ours.height},
                           reference,
                           ours,
                           1e-6,
                           renderers::povray_resolution()},
                          budget);
  EXPECT_EQ(budget.count(attribution::Cause::unexplained), 3U) << "of 256 pixels";
}

}  // namespace
}  // namespace plumb::tests
