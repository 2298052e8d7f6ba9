// Who is wrong, in pictures of which it is known.
#include "references/judgement.hpp"

#include <gtest/gtest.h>

#include "tests/support/run.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/scene/reader.hpp"

namespace plumb::references {
namespace {

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

  Judgement judged(const Image& reference, const Image& ours) const {
    return judge_pixels({scene_, scene_.cameras.front(), options_, reference, ours, 1e-6});
  }

  Scene scene_;
  RenderOptions options_;
  Image right_;
};

TEST_F(JudgedPictures, NothingIsJudgedWhereTheyAgree) { EXPECT_TRUE(judged(right_, right_).pixels.empty()); }

TEST_F(JudgedPictures, TheWrongSideIsNamed) {
  const Judgement ours = judged(right_, wrong_at(3, 4));
  ASSERT_EQ(ours.pixels.size(), 1U);
  EXPECT_EQ(ours.pixels[0].verdict, Verdict::ours_wrong);
  EXPECT_EQ(ours.pixels[0].x, 3);
  EXPECT_EQ(ours.pixels[0].y, 4);
  const Judgement reference = judged(wrong_at(3, 4), right_);
  ASSERT_EQ(reference.pixels.size(), 1U);
  EXPECT_EQ(reference.pixels[0].verdict, Verdict::reference_wrong);
}

TEST_F(JudgedPictures, BothMayBeWrong) {
  Image darker = right_;
  darker.pixel(3, 4)[1] -= 0.01F;
  EXPECT_EQ(judged(darker, wrong_at(3, 4)).count(Verdict::both_wrong), 1U);
}

TEST_F(JudgedPictures, TwoValuesOnEitherSideOfTheRightOneAreUndecided) {
  Image lower = right_;
  Image higher = right_;
  lower.pixel(3, 4)[1] -= 0.7e-6F;
  higher.pixel(3, 4)[1] += 0.7e-6F;
  EXPECT_EQ(judged(lower, higher).count(Verdict::undecided), 1U);
}

TEST_F(JudgedPictures, WhatIsNotJudgedIsCounted) {
  const AttributionJob job{scene_, scene_.cameras.front(), options_, right_, wrong_at(3, 4), 1e-6};
  const Judgement judgement = judge_pixels(job, 0);
  EXPECT_EQ(judgement.not_judged, 1U);
  EXPECT_TRUE(judgement.ran_out);
  EXPECT_FALSE(judgement.note().empty());
}

}  // namespace
}  // namespace plumb::references
