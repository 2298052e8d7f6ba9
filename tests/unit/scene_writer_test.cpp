// A scene that is written and read again is the same, bit for bit.
#include "tracer/format/writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>

#include "tests/support/random_scene.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb {
namespace {

/// The scene that the text of a scene gives; fails and shows errors if there are any.
Scene again(const Scene& scene) {
  const std::string text = write_scene(scene);
  const ReadResult result = read_scene(text);
  for (const Finding& finding : result.findings) {
    EXPECT_NE(finding.severity, Severity::error) << to_string(finding, "text") << "\n" << text;
  }
  return result.scene;
}

/// All numbers of a scene, in a fixed order, as bits: -0 differs from 0.
class Bits {
 public:
  explicit Bits(const Scene& scene) {
    add(scene.ambient, scene.background);
    for (const Material& m : scene.materials) add(m.ka, m.kd, m.ks, m.m, m.mirror, m.transmit, m.eta);
    for (const Light& l : scene.lights) add(l.position, l.color, l.brightness);
    for (const Camera& c : scene.cameras) {
      add(c.fov_x_degrees, c.eye, c.direction, c.up);
      add_steps(c.transform);
    }
    for (const Shape& shape : scene.shapes) {
      if (const auto* s = std::get_if<Sphere>(&shape.geometry)) add(s->center, s->radius);
      if (const auto* b = std::get_if<Box>(&shape.geometry)) add(b->min, b->max);
      add_steps(shape.transform);
    }
  }
  bool operator==(const Bits&) const = default;

 private:
  template <class... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }
  void add_one(double value) { bits_.push_back(std::bit_cast<std::uint64_t>(value)); }
  void add_one(const Vec3d& v) { add(v.x, v.y, v.z); }
  void add_steps(const std::vector<TransformStep>& steps) {
    for (const TransformStep& step : steps) {
      if (const auto* t = std::get_if<Translate>(&step)) add(t->by);
      if (const auto* r = std::get_if<Rotate>(&step)) add(r->degrees, r->axis);
      if (const auto* s = std::get_if<Scale>(&step)) add(s->by);
    }
  }

  std::vector<std::uint64_t> bits_;
};

/// One of everything, every number its own.
Scene complete() {
  Scene scene;
  Material glass;
  glass.name = "glass";
  glass.ka = {0.01, 0.02, 0.03};
  glass.kd = {0.04, 0.05, 0.06};
  glass.ks = {0.07, 0.08, 0.09};
  glass.m = 33.3;
  glass.mirror = {0.1, 0.2, 0.3};
  glass.transmit = {0.4, 0.5, 0.6};
  glass.eta = static_cast<double>(1.33F);
  Material matte;
  matte.name = "matte";
  scene.materials = {glass, matte};
  scene.shapes = {{"ball", Sphere{{1.1, 2.2, 3.3}, 4.4, 1}, {Translate{{5.5, 6.6, 7.7}}}},
                  {"box", Box{{-1.1, -2.2, -3.3}, {8.8, 9.9, 10.1}, 0}, {}},
                  {"all", Composite{{1, 0, 0}}, {Scale{{1.5, -2.5, 3.5}}, Rotate{12.5, {0.1, 0.2, 0.3}}}}};
  scene.lights = {{"lamp", {1.2, 3.4, 5.6}, {0.7, 0.8, 0.9}, 1.25}};
  scene.cameras = {{"eye", 55.5, {0.1, 0.2, 0.3}, {0.4, 0.5, -0.6}, {0.7, 0.8, 0.9}, {Translate{{1, 2, 3}}}},
                   {"other", 33, {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}}};
  scene.renders = {{"other", "a.ppm", 7, 8}, {"eye", "dir/b.png", 9, 10}};
  scene.ambient = {0.11, 0.12, 0.13};
  scene.background = {0.14, 0.15, 16};
  return scene;
}

TEST(SceneWriter, EveryPartOfASceneComesBack) { EXPECT_EQ(again(complete()), complete()); }

TEST(SceneWriter, TheTextIsTheCourseGrammarStrictly) {
  const ReadResult result = read_scene(write_scene(complete()));
  for (const Finding& finding : result.findings) {
    EXPECT_NE(finding.message.find("more than one render"), std::string::npos) << finding.message;
  }
}

TEST(SceneWriter, RandomScenesComeBackBitForBit) {
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    const Scene scene = tests::random_scene(seed).scene;
    const Scene read = again(scene);
    ASSERT_EQ(read, scene) << "seed " << seed;
    ASSERT_EQ(Bits(read), Bits(scene)) << "seed " << seed;
  }
}

TEST(SceneWriter, WhatIsReadAndWrittenAgainIsTheSameText) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::string text = write_scene(tests::random_scene(seed).scene);
    ASSERT_EQ(write_scene(read_scene(text).scene), text) << "seed " << seed;
  }
}

TEST(SceneWriter, DifferentScenesHaveDifferentTexts) {
  Scene changed = complete();
  changed.lights[0].position.y = std::nextafter(changed.lights[0].position.y, 9.0);
  EXPECT_NE(write_scene(changed), write_scene(complete()));
}

// --- numbers -------------------------------------------------------------------------------------

class SpecialNumber : public testing::TestWithParam<double> {};

TEST_P(SpecialNumber, ComesBackAsAPosition) {
  Scene scene = complete();
  const double x = GetParam();
  scene.lights[0].position = {x, -x, x};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

TEST_P(SpecialNumber, ComesBackAsAColour) {
  Scene scene = complete();
  const double x = GetParam();
  scene.ambient = scene.background = scene.materials[0].ka = scene.materials[0].kd = {x, -x, x};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

TEST_P(SpecialNumber, ComesBackAsAMirrorOrATransmission) {
  Scene scene = complete();
  const double x = GetParam();
  scene.materials[0].mirror = scene.materials[0].transmit = {x, -x, x};
  scene.materials[1].mirror = {0, 0, x};
  scene.materials[1].transmit = {x, 0, 0};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

TEST_P(SpecialNumber, ComesBackAsATranslation) {
  Scene scene = complete();
  const double x = GetParam();
  scene.shapes[0].transform = {Translate{{x, -x, x}}};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

TEST_P(SpecialNumber, ComesBackAsTheCentreOfASphere) {
  Scene scene = complete();
  const double x = GetParam();
  scene.shapes[0].geometry = Sphere{{x, -x, x}, 1, 0};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

TEST_P(SpecialNumber, ComesBackAsTheCornersOfABox) {
  Scene scene = complete();
  const double x = std::abs(GetParam());
  scene.shapes[1].geometry = Box{{-x, -x, -x}, {x, x, x}, 0};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

INSTANTIATE_TEST_SUITE_P(SceneWriter, SpecialNumber,
                         testing::Values(0.0, -0.0, 0.1, 1.0 / 3, 1e-300, 5e-324, 2.2250738585072014e-308,
                                         1e100, 0.30000000000000004, 123456789012345680.0, 1e22, 1e23,
                                         9007199254740993.0, 0x1.fffffffffffffp+10),
                         [](const auto& instance) { return "Number" + std::to_string(instance.index); });

TEST(SceneWriter, TheSmallestLengthsComeBack) {
  Scene scene = complete();
  scene.shapes[0].geometry = Sphere{{0, 0, 0}, 1e-100, 0};
  scene.shapes[0].transform = {Scale{{1e-100, -1e-100, 1}}};
  EXPECT_EQ(Bits(again(scene)), Bits(scene));
}

TEST(SceneWriter, RefractiveIndicesAreThoseOfFloat32) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> indices(0.5F, 3);
  for (int i = 0; i < 200; ++i) {
    Scene scene = complete();
    scene.materials[0].eta = static_cast<double>(indices(random));
    ASSERT_EQ(again(scene).materials[0].eta, scene.materials[0].eta);
  }
}

TEST(SceneWriter, ARefractiveIndexIsKeptWithoutTransmission) {
  Scene scene = complete();
  scene.materials[1].eta = 1.5;
  EXPECT_EQ(again(scene).materials[1].eta, 1.5);
}

TEST(SceneWriter, NumbersAreAsShortAsTheyCanBe) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(2), "2");
  EXPECT_EQ(to_text(-0.0), "-0");
  EXPECT_EQ(to_text(0.1 + 0.2), "0.30000000000000004");
}

TEST(SceneWriter, AnyBitsOfAFiniteNumberComeBack) {
  std::mt19937_64 random(2);
  int finite = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    ++finite;
    const std::string text = to_text(value);
    double back = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(error, std::errc()) << text;
    ASSERT_EQ(end, text.data() + text.size()) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << text;
  }
  EXPECT_GT(finite, 19000);
}

}  // namespace
}  // namespace plumb
