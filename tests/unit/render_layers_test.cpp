// The layers of a picture: what the first ray meets, and the terms of its colour.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/scene/shot.hpp"
#include "tracer/textbook/layers.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::textbook {
namespace {

constexpr float rounding = 2e-6F;  // because eight values of at most some 4 are rounded to float32

/// One pixel's values by the names of their channels.
class Pixel {
 public:
  Pixel(const ImageFile& picture, std::size_t number)
      : picture_(picture), first_(number * static_cast<std::size_t>(picture.channels)) {}

  float operator[](const std::string& channel) const {
    const auto& names = picture_.contents.channels;
    const auto found = std::ranges::find(names, channel);
    EXPECT_NE(found, names.end()) << channel;
    return picture_.values[first_ + static_cast<std::size_t>(found - names.begin())];
  }

 private:
  const ImageFile& picture_;
  std::size_t first_;
};

const std::vector<Layer> all_layers{Layer::normal,   Layer::depth,     Layer::point,     Layer::object,
                                    Layer::shadow,   Layer::direction, Layer::ambient,   Layer::diffuse,
                                    Layer::specular, Layer::mirror,    Layer::refraction};

RenderJob small_job(const Shot& shot) {
  RenderJob job = job_of(shot);
  job.width = 40;
  job.height = 30;
  return job;
}

class OfAScene : public testing::TestWithParam<std::string> {};

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(tests::source_path("tests/scenes")))
    if (entry.path().extension() == ".sdf") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

TEST_P(OfAScene, TheTermsAddUpToThePicture) {
  const Scene scene = load_scene(tests::source_path("tests/scenes/" + GetParam() + ".sdf"), {});
  const Shot shot = shot_of(scene, {});
  const RenderJob job = small_job(shot);
  const ImageFile layers = render_layers(scene, shot.camera, job, all_layers);
  const Image picture = render(scene, shot.camera, job);
  for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
    const Pixel pixel(layers, i);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const std::string c(1, "RGB"[channel]);
      const float colour = picture.rgb[3 * i + channel];
      ASSERT_EQ(pixel[c], colour);
      const float sum = pixel["ambient." + c] + pixel["diffuse." + c] + pixel["specular." + c] +
                        pixel["mirror." + c] + pixel["refraction." + c];
      const float shown =
          pixel["object.id"] == 0 ? static_cast<float>(scene.background[static_cast<int>(channel)]) : sum;
      ASSERT_NEAR(shown, colour, rounding * std::max(1.0F, colour)) << i;
    }
  }
}

TEST_P(OfAScene, ThePointLiesAsDeepAsTheRaySays) {
  const Scene scene = load_scene(tests::source_path("tests/scenes/" + GetParam() + ".sdf"), {});
  const Shot shot = shot_of(scene, {});
  const RenderJob job = small_job(shot);
  const ImageFile layers = render_layers(scene, shot.camera, job, all_layers);
  const CameraPose<double> pose = pose_of<double>(shot.camera);
  for (std::size_t i = 0; i < static_cast<std::size_t>(job.width * job.height); ++i) {
    const Pixel pixel(layers, i);
    const auto vector = [&](const std::string& layer) {
      return Vec3d(pixel[layer + ".X"], pixel[layer + ".Y"], pixel[layer + ".Z"]);
    };
    ASSERT_NEAR(glm::length(vector("direction")), 1, 1e-6);
    if (pixel["object.id"] == 0) {
      ASSERT_EQ(pixel["depth.Z"], 0);
      ASSERT_EQ(glm::length(vector("normal")), 0);
      continue;
    }
    const double depth = pixel["depth.Z"];
    ASSERT_NEAR(glm::length(vector("normal")), 1, 1e-6);
    ASSERT_LE(glm::dot(vector("normal"), vector("direction")), 1e-6);
    const Vec3d point = pose.eye + depth * vector("direction");
    ASSERT_NEAR(glm::length(point - vector("point")), 0, 1e-6 * (depth + glm::length(pose.eye)));
  }
}

INSTANTIATE_TEST_SUITE_P(RenderLayers, OfAScene, testing::ValuesIn(scenes()), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

/// A floor, a box that hides the first light from its left half, and a second light behind the floor.
constexpr const char* floor_and_box = R"(ambient 1 1 1
camera eye 60 0 5 0 0 -1 0 0 0 -1
define light hidden 0 5 0 1 1 1 1
define light below 0 -5 0 1 1 1 1
define material grey 0.1 0.1 0.1 0.5 0.5 0.5 0 0 0 1
define shape box lid -10 4 -10 0 4.5 10 grey
define shape box floor -10 -1 -10 10 0 10 grey
render eye out.ppm 40 30
)";

TEST(RenderLayers, AShadowIsWhereALightInFrontIsHidden) {
  const ReadResult read = read_scene(floor_and_box);
  for (const Finding& finding : read.findings)
    ASSERT_NE(finding.severity, Severity::error) << finding.message;
  const Shot shot = shot_of(read.scene, {});
  EXPECT_EQ(channels_of(Layer::shadow, read.scene), (std::vector<std::string>{"shadow.1", "shadow.2"}));
  const ImageFile layers =
      render_layers(read.scene, shot.camera, job_of(shot), {Layer::shadow, Layer::point, Layer::object});
  std::size_t lit = 0, hidden = 0;
  for (std::size_t i = 0; i < layers.values.size() / static_cast<std::size_t>(layers.channels); ++i) {
    const Pixel pixel(layers, i);
    EXPECT_EQ(pixel["shadow.2"], 0) << "the light is behind the floor";
    if (pixel["object.id"] != 2) continue;
    const bool is_lit = pixel["point.X"] > 0;
    (is_lit ? lit : hidden) += 1;
    EXPECT_EQ(pixel["shadow.1"], is_lit ? 0 : 1) << pixel["point.X"];
  }
  EXPECT_GT(lit, 100U);
}

TEST(RenderLayers, TooManyValuesAreRefusedBeforeTheyAreMade) {
  const Scene scene = read_scene(floor_and_box).scene;
  const Shot shot = shot_of(scene, {});
  RenderJob job = job_of(shot);
  job.width = job.height = 20000;
  EXPECT_THROW(render_layers(scene, shot.camera, job, all_layers), std::runtime_error);
}

}  // namespace
}  // namespace plumb::textbook
