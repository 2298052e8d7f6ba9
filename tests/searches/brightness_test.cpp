// Pictures that are right but for their brightness are called so, and accuse nobody.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "references/diagnosis/diagnosis.hpp"
#include "references/renderers/ours.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::diagnosis {
namespace {

using Level = std::function<double(double level)>;

struct Stretched {
  const char* name;
  const char* habit;
  double value;
  Level level;
};

const std::vector<Stretched>& stretched() {
  static const std::vector<Stretched> all{
      {"0.8", "gain", 0.8, [](double v) { return std::floor(0.8 * v); }},
      {"1.3", "gain", 1.3, [](double v) { return std::floor(std::min(255.0, 1.3 * v)); }},
      {"31 to 255", "levels", 224.0 / 255, [](double v) { return std::round(31 + v * 224 / 255); }}};
  return all;
}

/// Tone-mapped and truncated, as the course's framework has it.
ImageFile written(const Image& image) {
  ImageFile file;
  file.width = image.width;
  file.height = image.height;
  file.channels = 3;
  file.sample = Sample::bits8;
  for (const float c : image.rgb) file.values.push_back(std::floor(255 * c / (c + 1)) / 255);
  return file;
}

class RightButForBrightness : public testing::TestWithParam<const char*> {
 protected:
  RightButForBrightness()
      : scene_(load_scene(tests::source_path(std::string("tests/scenes/") + GetParam() + ".sdf"), {})),
        shot_(shot_of(scene_, {})) {}

  Image picture_of(const Scene& scene) const {
    return renderers::render(renderers::OwnTracer::engine, scene, scene.camera(shot_.camera.name),
                             job_of(shot_));
  }
  void expect_habit(const ImageFile& file, const std::string& habit, double value, const char* what) const {
    const Diagnosis found = diagnose(scene_, shot_.camera, job_of(shot_), file);
    EXPECT_EQ(found.verdict, PictureVerdict::right_apart) << what;
    EXPECT_TRUE(found.explains_all()) << what;
    EXPECT_TRUE(found.faults.empty()) << what;
    ASSERT_EQ(found.habits.size(), 1U) << what;
    EXPECT_EQ(found.habits.front().id, habit) << what;
    EXPECT_NEAR(found.habits.front().value.r, value, 0.03 * value) << what;
  }

  Scene scene_;
  Shot shot_;
};
INSTANTIATE_TEST_SUITE_P(Scenes, RightButForBrightness,
                         testing::Values("phong", "combined-still-life", "refraction"), [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(RightButForBrightness, AStretchedPictureIsToldAsThat) {
  const ImageFile right = written(picture_of(scene_));
  for (const auto& [name, habit, slope, level] : stretched()) {
    ImageFile file = right;
    for (float& value : file.values) value = static_cast<float>(level(std::round(255 * double{value})) / 255);
    expect_habit(file, habit, slope, name);
  }
}

TEST_P(RightButForBrightness, LightsThatAreAllDimmerAreToldAsThat) {
  Scene dim = scene_;
  dim.ambient *= 0.7;
  dim.background *= 0.7;
  for (Light& light : dim.lights) light.brightness *= 0.7;
  expect_habit(written(picture_of(dim)), "gain", 0.7, "dim");
}

/// One light of several, or the ambient light alone, is another cause.
TEST_P(RightButForBrightness, OneLightThatIsDimmerIsNot) {
  Scene dim = scene_;
  dim.lights.front().brightness *= 0.7;
  const Diagnosis found = diagnose(scene_, shot_.camera, job_of(shot_), written(picture_of(dim)));
  EXPECT_TRUE(std::ranges::none_of(
      found.habits, [](const Habit& habit) { return habit.id == "gain" || habit.id == "levels"; }));
  EXPECT_NE(found.verdict, PictureVerdict::right);
}

}  // namespace
}  // namespace plumb::diagnosis
