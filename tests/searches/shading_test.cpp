// The shading of a picture, told where the background and other things are the tracer's own.
#include "references/diagnosis/shading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "references/diagnosis/diagnosis.hpp"
#include "tests/support/room_scene.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

const textbook::RenderJob shading_job = tests::job_of(360, 240);

/// The room, with a mirror, a second light, and a ball beyond a light.
Scene room() {
  Scene scene = read_scene(tests::room_scene).scene;
  scene.materials.front().mirror = Rgbd(0.4);
  scene.lights.push_back({"fill", {-3, 5, 4}, {0.5, 0.6, 0.9}, 0.7});
  Shape beyond = scene.shapes.front();
  beyond.name = "beyond";
  std::get<Sphere>(beyond.geometry) = {{6, 9, 4}, 1.5};
  scene.shapes.push_back(beyond);
  return scene;
}

Scene with_background(Scene scene, const Rgbd& background) {
  scene.background = background;
  return scene;
}

diagnosis::Diagnosis diagnosed(const Scene& asked, const Scene& painted,
                               const std::vector<const faults::Fault*>& faults) {
  return diagnosis::diagnose(asked, asked.cameras.front(), shading_job,
                             tests::picture_of(painted, shading_job, faults));
}

/// A fault of the catalogue, or the member of a family with this constant.
const faults::Fault* fault_of(const std::string& id, double value) {
  if (std::isnan(value)) return faults::find_fault(id);
  for (const faults::Fault& fault : faults::shading_families())
    if (fault.id == id && fault.value == value) return &fault;
  return nullptr;
}

struct Named {
  const char* id;
  double value = std::numeric_limits<double>::quiet_NaN();
};

class ShadingOf : public testing::TestWithParam<Named> {};

/// With a background of its own, which no search over formulas explains.
TEST_P(ShadingOf, TheFaultIsNamedFirstAndNothingElse) {
  const faults::Fault* const fault = fault_of(GetParam().id, GetParam().value);
  ASSERT_NE(fault, nullptr);
  const Scene scene = room();
  const diagnosis::Diagnosis found = diagnosed(scene, with_background(scene, {0.9, 0.5, 0.1}), {fault});
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::faults);
  ASSERT_EQ(found.faults.size(), 1U);
  EXPECT_EQ(found.faults.front().fault->id, fault->id);
  EXPECT_GT(found.faults.front().pixels, 0U);
  EXPECT_GE(found.faults.front().changed, found.faults.front().pixels / 2);
  EXPECT_EQ(found.certain.camera, diagnosis::Certainty::right);
  ASSERT_EQ(found.habits.size(), 1U);
  EXPECT_EQ(found.habits.front().id, "background");
}

INSTANTIATE_TEST_SUITE_P(Faults, ShadingOf,
                         testing::Values(Named{"shadows-missing"}, Named{"diffuse-missing"},
                                         Named{"specular-missing"}, Named{"ambient-missing"},
                                         Named{"light-once-per-object"}, Named{"every-object-mirrors"},
                                         Named{"ambient-hard-coded", 0.4}, Named{"exponent-fixed", 5},
                                         Named{"light-vector-not-normalised"}),
                         [](const auto& of) {
                           std::string name = of.param.id;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Shading, IsRightBesideAnotherBackground) {
  const Scene scene = room();
  const diagnosis::Diagnosis found = diagnosed(scene, with_background(scene, {0.9, 0.5, 0.1}), {});
  EXPECT_EQ(found.verdict, diagnosis::PictureVerdict::right_apart);
  EXPECT_TRUE(found.faults.empty());
  EXPECT_EQ(found.certain.camera, diagnosis::Certainty::right);
  EXPECT_EQ(found.certain.shadows, diagnosis::Certainty::right);
  EXPECT_EQ(found.certain.shading, diagnosis::Certainty::right);
}

/// A level too bright, or a little more ambient light in floats, is not right beside another background.
TEST(Shading, IsNotRightWhenItIsAlmost) {
  const Scene scene = room();
  const Scene painted = with_background(scene, {0.9, 0.5, 0.1});
  ImageFile brighter = tests::picture_of(painted, shading_job, {});
  const ImageFile background = tests::picture_of(painted, shading_job, {});
  for (std::size_t i = 0; i < brighter.values.size(); ++i) {
    const bool is_background = std::abs(background.values[i - i % 3] - std::floor(255 * 0.9F) / 255) < 1e-6F;
    if (!is_background && brighter.values[i] < 1) brighter.values[i] += 1.0F / 255;
  }
  Scene lighter = painted;
  lighter.ambient *= 1.003;
  const Image image = faults::render_with(lighter, lighter.cameras.front(), shading_job, {});
  const ImageFile in_floats{image.width, image.height, 3, Sample::float32, image.rgb, {}};
  for (const ImageFile& picture : {brighter, in_floats}) {
    const diagnosis::Diagnosis found =
        diagnosis::diagnose(scene, scene.cameras.front(), shading_job, picture);
    EXPECT_FALSE(found.explains_all());
    EXPECT_NE(found.verdict, diagnosis::PictureVerdict::right);
    EXPECT_NE(found.certain.shading, diagnosis::Certainty::right);
    EXPECT_NE(found.certain.shadows, diagnosis::Certainty::right);
  }
}

/// What no formula of the catalogue does accuses nobody.
TEST(Shading, AnotherMaterialOrLightIsNoFault) {
  const Scene scene = room();
  Scene lit_from_elsewhere = with_background(scene, {0.9, 0.5, 0.1});
  lit_from_elsewhere.lights.front().position = {-1, 8, 3};
  Scene of_other_colours = with_background(scene, {0.9, 0.5, 0.1});
  for (Material& material : of_other_colours.materials) material.kd = Rgbd(1) - material.kd;
  for (const Scene& painted : {lit_from_elsewhere, of_other_colours}) {
    const diagnosis::Diagnosis found = diagnosed(scene, painted, {});
    EXPECT_TRUE(found.faults.empty()) << found.faults.front().fault->id;
    EXPECT_EQ(found.certain.camera, diagnosis::Certainty::right);
    EXPECT_NE(found.certain.shading, diagnosis::Certainty::right);
  }
}

/// The camera's faults that edges alone leave open are proven by the colours that they give.
TEST(Shading, ProvesACameraAndATransformTogether) {
  Scene scene = room();
  for (Shape& shape : scene.shapes)
    if (shape.name == "block") shape.transform = {Rotate{20, {0, 1, 0}}, Translate{{0.3, 0.2, -0.5}}};
  const faults::Fault* const field = faults::find_fault("full-angle-as-half");
  const auto sense = std::find_if(faults::geometry_families().begin(), faults::geometry_families().end(),
                                  [](const faults::Fault& f) { return f.id == "rotation-sense-about-y"; });
  const diagnosis::Diagnosis found =
      diagnosed(scene, with_background(scene, {0.9, 0.5, 0.1}), {field, &*sense});
  std::vector<int> numbers;
  for (const diagnosis::FoundFault& one : found.faults) numbers.push_back(one.fault->catalogue);
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(numbers, (std::vector<int>{2, 28}));
  EXPECT_EQ(found.certain.camera, diagnosis::Certainty::wrong);
}

}  // namespace
}  // namespace plumb::tests
