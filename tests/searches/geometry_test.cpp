// The camera of a picture, told by where things are. Colours are changed on purpose.
#include "references/diagnosis/geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "references/diagnosis/diagnosis.hpp"
#include "tests/support/room_scene.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

constexpr const char* another = R"(define material grey 0.4 0.4 0.4 0.5 0.5 0.5 0.3 0.3 0.3 20
define shape sphere a 0.3 1.4 -4 0.5 grey
define shape sphere b -1.6 -1 -4 0.4 grey
define light key -4 6 2 1 1 1 1
ambient 0.3 0.3 0.3
background 0.6 0.5 0.3
define camera eye 60
render eye out.ppm 150 100
)";

const textbook::RenderJob geometry_job = tests::job_of(150, 100);

/// The room by a tracer that has a black background, half the light and no highlights.
Scene in_other_colours(Scene scene) {
  scene.background = Rgbd(0);
  for (Light& light : scene.lights) light.brightness *= 0.5;
  for (Material& material : scene.materials) material.ks = Rgbd(0);
  return scene;
}

bool names(const diagnosis::CameraFound& camera, const faults::Fault* fault) {
  for (std::size_t i = 0; i < camera.assumed.size(); ++i) {
    const auto& alike = camera.alike[i];
    const bool is_it =
        camera.assumed[i] == fault || std::find(alike.begin(), alike.end(), fault) != alike.end();
    const bool is_sure =
        std::find(camera.faults.begin(), camera.faults.end(), camera.assumed[i]) != camera.faults.end();
    if (is_it && is_sure) return true;
  }
  return false;
}

class GeometryOf : public testing::TestWithParam<const char*> {};

TEST_P(GeometryOf, TheFaultIsNamedWhateverTheColours) {
  const Scene scene = read_scene(tests::room_scene).scene;
  const std::string id = GetParam();
  const faults::Fault* const fault =
      faults::find_fault(id) != nullptr ? faults::find_fault(id) : faults::find_geometry_family(id);
  ASSERT_NE(fault, nullptr);
  const auto found =
      diagnosis::geometry_of(scene, scene.cameras.front(), geometry_job,
                             tests::picture_of(in_other_colours(scene), geometry_job, {fault}));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->camera.is_right);
  EXPECT_TRUE(names(found->camera, fault));
  EXPECT_EQ(found->camera.faults.size(), 1U);
  EXPECT_GT(found->camera.pixels, 0U);
}

INSTANTIATE_TEST_SUITE_P(Faults, GeometryOf,
                         testing::Values("full-angle-as-half", "aspect-ignored", "field-of-view-vertical",
                                         "field-of-view-fixed", "focal-length-of-its-own",
                                         "aspect-in-whole-numbers", "camera-transform-ignored", "upside-down",
                                         "left-right-swapped"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Geometry, TwoFaultsAreNamedTogether) {
  const Scene scene = read_scene(tests::room_scene).scene;
  const faults::Fault* const field = faults::find_fault("full-angle-as-half");
  const faults::Fault* const aspect = faults::find_fault("aspect-ignored");
  const auto found =
      diagnosis::geometry_of(scene, scene.cameras.front(), geometry_job,
                             tests::picture_of(in_other_colours(scene), geometry_job, {field, aspect}));
  ASSERT_TRUE(found);
  EXPECT_TRUE(names(found->camera, field));
  EXPECT_TRUE(names(found->camera, aspect));
}

TEST(Geometry, ARightCameraIsRightWhateverTheColours) {
  const Scene scene = read_scene(tests::room_scene).scene;
  const auto found = diagnosis::geometry_of(scene, scene.cameras.front(), geometry_job,
                                            tests::picture_of(in_other_colours(scene), geometry_job, {}));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->camera.is_right);
  EXPECT_TRUE(found->camera.faults.empty());
  ASSERT_TRUE(found->background);
  EXPECT_EQ(found->background->colour, Rgbd(0));
}

TEST(Geometry, AnotherScenesPictureAccusesNobody) {
  const Scene scene = read_scene(tests::room_scene).scene;
  const auto found = diagnosis::geometry_of(scene, scene.cameras.front(), geometry_job,
                                            tests::picture_of(read_scene(another).scene, geometry_job, {}));
  EXPECT_TRUE(!found || (found->camera.faults.empty() && !found->camera.is_right));
}

TEST(Geometry, AFaultOfTheCameraIsNamedBesideColoursThatNothingExplains) {
  const Scene scene = read_scene(tests::room_scene).scene;
  const faults::Fault* const aspect = faults::find_fault("aspect-ignored");
  const diagnosis::Diagnosis found =
      diagnosis::diagnose(scene, scene.cameras.front(), geometry_job,
                          tests::picture_of(in_other_colours(scene), geometry_job, {aspect}));
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::faults);
  ASSERT_EQ(found.faults.size(), 1U);
  EXPECT_EQ(found.faults.front().fault, aspect);
  EXPECT_FALSE(found.explains_all());
  EXPECT_EQ(found.certain.camera, diagnosis::Certainty::wrong);
  ASSERT_EQ(found.habits.size(), 1U);
  EXPECT_EQ(found.habits.front().id, "background");
}

}  // namespace
}  // namespace plumb::tests
