// The cheapest configuration within an error: what it claims is measured again by other means.
#include "references/studies/needs/choice.hpp"

#include <gtest/gtest.h>

#include "references/comparison/comparison.hpp"
#include "tests/support/run.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::tests {
namespace {

using studies::Choice;

Scene course_scene(const std::string& name) {
  return load_scene(source_path("tests/scenes/" + name + ".sdf"), {});
}

Scene scene_of(const std::string& text) { return read_scene(text).scene; }

const Camera& camera_of(const Scene& scene) { return scene.camera(scene.renders.front().camera); }

RenderJob job_of(int width = 40, int height = 30) {
  RenderJob job;
  job.width = width;
  job.height = height;
  return job;
}

Choice chosen(const Scene& scene, double bound, const RenderJob& job = job_of()) {
  return studies::choose(scene, camera_of(scene), job, bound);
}

/// The whole picture in 113 bits, as users render it.
Image in_quad(const Scene& scene, RenderJob job = job_of()) {
  job.real = RealType::quad;
  return textbook::render(scene, camera_of(scene), job);
}

/// Because the oracle's picture is rounded to float here, and was not where the error was measured.
constexpr double rounding_of_float = 6e-8;

TEST(Choose, TheErrorThatItReportsIsTheErrorThatThereIs) {
  for (const char* name : {"phong", "recursion-depth", "total-reflection"}) {
    const Scene scene = course_scene(name);
    const Image right = in_quad(scene);
    for (const double bound : {0.3, 1e-2, 1e-4, 1e-7}) {
      const Choice choice = chosen(scene, bound);
      EXPECT_EQ(choice.oracle_pixels, 1200U);
      EXPECT_LE(choice.chosen.error.largest(), bound);
      EXPECT_NEAR(comparison::compare(right, choice.image, 0).judged_error,
                  choice.chosen.error.against_oracle, rounding_of_float)
          << name << " " << bound;
    }
  }
}

TEST(Choose, AWideBoundTakesFloatAndLessDepthAndANarrowOneDouble) {
  const Scene scene = course_scene("recursion-depth");
  const Choice wide = chosen(scene, 0.05), narrow = chosen(scene, 1e-7);
  EXPECT_EQ(wide.chosen.real, RealType::float32);
  EXPECT_LT(wide.chosen.depth, 8);
  EXPECT_EQ(narrow.chosen.real, RealType::float64);
  EXPECT_EQ(narrow.chosen.depth, 8);
  EXPECT_NE(studies::reason(wide, 0.05, 8).find("float, depth "), std::string::npos);
}

TEST(Choose, TheDepthIsTheLeastThatStaysUnderTheBound) {
  const Scene scene = course_scene("recursion-depth");
  const Choice choice = chosen(scene, 0.05);
  RenderJob job = job_of();
  job.real = RealType::float32;
  job.options.depth = choice.chosen.depth - 1;
  const Image shallower = engine::render(scene, camera_of(scene), job);
  EXPECT_GT(comparison::compare(in_quad(scene), shallower, 0).judged_error, 0.05);
}

/// So far off the origin that to double the ball is where the eye is.
Scene far_off() {
  return scene_of(
      "define material m 0.1 0.1 0.1 0.6 0.5 0.4 0 0 0 1\nambient 1 1 1\n"
      "define shape sphere ball 1e13 0 -4 1 m\ndefine light lamp 1e13 6 0 1 1 1 1\n"
      "define camera eye 40 1e13 0 0 0 0 -1 0 1 0\n");
}

TEST(Choose, WhereDoubleFailsLongDoubleIsTaken) {
  const Scene scene = far_off();
  const Choice choice = chosen(scene, 1e-4);
  EXPECT_EQ(choice.chosen.real, RealType::long_double);
  EXPECT_FALSE(choice.chosen.error.against_double.has_value());
  EXPECT_LE(comparison::compare(in_quad(scene), choice.image, 0).judged_error, 1e-4);
}

TEST(Choose, RefusesABoundThatNothingReachesAndSaysWhatWasReached) {
  try {
    chosen(course_scene("phong"), 1e-12);
    FAIL() << "no float picture is as exact";
  } catch (const studies::BoundNotReached& error) {
    const std::string said = error.what();
    for (const char* part : {"1e-12", "float", "double", "long-double", "--real quad"})
      EXPECT_NE(said.find(part), std::string::npos) << part << " is missing in\n" << said;
  }
}

TEST(Choose, TheOracleAveragesTheSamplesOfAGridAndKnowsNoOtherPattern) {
  const Scene scene = course_scene("sphere");
  RenderJob job = job_of();
  job.samples = 4;
  const Choice choice = chosen(scene, 1e-4, job);
  const Image fine = in_quad(scene, job_of(80, 60));
  for (const auto& [x, y] : {std::pair{20, 15}, {11, 17}, {28, 9}}) {
    for (int channel = 0; channel < 3; ++channel) {
      const float mean = (fine.pixel(2 * x, 2 * y)[channel] + fine.pixel(2 * x + 1, 2 * y)[channel] +
                          fine.pixel(2 * x, 2 * y + 1)[channel] + fine.pixel(2 * x + 1, 2 * y + 1)[channel]) /
                         4;
      EXPECT_NEAR(choice.image.pixel(x, y)[channel], mean, 1e-4);
    }
  }
  job.pattern = SamplePattern::low_discrepancy;
  EXPECT_THROW(chosen(scene, 1e-4, job), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::tests
