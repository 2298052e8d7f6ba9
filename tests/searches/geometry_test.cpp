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

constexpr const char* two_turned = R"(define material grey 0.4 0.4 0.4 0.5 0.5 0.5 0.3 0.3 0.3 20
define material red 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20
define shape box floor -6 -3 -9 6 -1.6 -3 grey
define shape box post -0.5 -0.5 -0.5 0.5 1.5 0.5 red
define shape sphere egg 0 0 0 0.6 grey
transform post rotate 70 0 0 1
transform post translate -1.2 0.3 -5
transform egg scale 1.8 0.7 1
transform egg rotate 40 0 0 1
transform egg translate 1.3 0.2 -5
define light key -4 6 2 1 1 1 1
ambient 0.3 0.3 0.3
background 0.1 0.15 0.5
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

const faults::Fault* any_fault(const std::string& id) {
  const faults::Fault* const fault = faults::find_fault(id);
  return fault != nullptr ? fault : faults::find_geometry_family(id);
}

class GeometryOf : public testing::TestWithParam<const char*> {};

TEST_P(GeometryOf, TheFaultIsNamedWhateverTheColours) {
  const Scene scene = read_scene(tests::room_scene).scene;
  const faults::Fault* const fault = any_fault(GetParam());
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

/// The post by this fault, and the egg where no fault puts it.
ImageFile picture_of_two(const faults::Fault* fault, double degrees_of_the_post) {
  Scene scene = in_other_colours(read_scene(two_turned).scene);
  for (Shape& shape : scene.shapes) {
    if (shape.name == "egg") shape.transform.emplace_back(Translate{{0.1, 0.6, 0.2}});
    for (TransformStep& step : shape.transform) {
      if (auto* const turn = std::get_if<Rotate>(&step); turn && shape.name == "post")
        turn->degrees = degrees_of_the_post;
    }
  }
  std::vector<const faults::Fault*> faults;
  if (fault != nullptr) faults.push_back(fault);
  return tests::picture_of(scene, geometry_job, faults);
}

TEST(Geometry, AFaultOfOneShapesTransformIsNamedWhateverAnotherShapeDoes) {
  const Scene scene = read_scene(two_turned).scene;
  for (const char* const id : {"rotation-by-half", "rotation-sense-about-z"}) {
    const faults::Fault* const fault = any_fault(id);
    ASSERT_NE(fault, nullptr);
    const auto found =
        diagnosis::geometry_of(scene, scene.cameras.front(), geometry_job, picture_of_two(fault, 70));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->elsewhere.size(), 1U) << id;
    const auto& [named, alike, pixels] = found->elsewhere.front();
    EXPECT_TRUE(named == fault || std::find(alike.begin(), alike.end(), fault) != alike.end()) << id;
    EXPECT_GT(pixels, 100U);
  }
}

TEST(Geometry, AShapeThatNoFaultPutsThereAccusesNobody) {
  const Scene scene = read_scene(two_turned).scene;
  for (const double degrees : {70.0, 45.0, 25.0, -30.0}) {
    const auto found =
        diagnosis::geometry_of(scene, scene.cameras.front(), geometry_job, picture_of_two(nullptr, degrees));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->elsewhere.empty()) << degrees;
  }
}

}  // namespace
}  // namespace plumb::tests
