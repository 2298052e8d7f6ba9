// The gates whose power is published: each passes what it should and can fail.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bench/gate_power/our_gate.hpp"
#include "tests/bench/gate_power/rules.hpp"
#include "tests/bench/gate_power/yiq.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::gate_power {
namespace {

Subject subject_of(const std::string& file) {
  const Scene scene = read_scene(read_file(tests::source_path("tests/scenes/" + file))).scene;
  Subject s{file, scene, scene.camera(scene.renders.front().camera), {}, {}};
  s.job.width = 40;
  s.job.height = 30;
  s.job.threads = 1;
  s.right = textbook::render(s.scene, s.camera, s.job);
  return s;
}

Image grey(float value) {
  Image image(100, 100);
  std::fill(image.rgb.begin(), image.rgb.end(), value);
  return image;
}

bool passes(const std::string& name, const Image& right, const Image& given) {
  const auto& all = rules();
  const auto rule = std::find_if(all.begin(), all.end(), [&](const Rule& r) { return name == r.name; });
  EXPECT_NE(rule, all.end()) << name;
  return rule->passes(pair_of(right, given, Made::in_double));
}

/// Grey, with the first components made brighter.
Image with_components(int count, float by) {
  Image image = grey(0.5F);
  for (int i = 0; i < count; ++i) image.rgb[static_cast<std::size_t>(i)] += by;
  return image;
}

TEST(GateRules, AllPassTheSamePicture) {
  const Image image = subject_of("phong.sdf").right;
  for (const Rule& rule : rules())
    EXPECT_TRUE(rule.passes(pair_of(image, image, Made::in_double))) << rule.name;
}

TEST(GateRules, OpenImageIOsThresholdsAreItsOwn) {
  const std::string name = "OpenImageIO's tests";
  EXPECT_TRUE(passes(name, grey(0.5F), with_components(6, 0.005F))) << "2 of 10,000 pixels are 0.02 %";
  EXPECT_FALSE(passes(name, grey(0.5F), with_components(9, 0.005F)));
  EXPECT_TRUE(passes(name, grey(0.5F), with_components(1, 0.0119F)));
  EXPECT_FALSE(passes(name, grey(0.5F), with_components(1, 0.0121F)));
}

TEST(GateRules, BlenderAllowsOnePerCentOfThePixels) {
  EXPECT_TRUE(passes("Blender's tests", grey(0.5F), with_components(300, 0.2F)));
  EXPECT_FALSE(passes("Blender's tests", grey(0.5F), with_components(303, 0.2F)));
}

TEST(GateRules, AppleseedAllowsEightComponents) {
  EXPECT_TRUE(passes("appleseed's tests", grey(0.5F), with_components(8, 0.2F)));
  EXPECT_FALSE(passes("appleseed's tests", grey(0.5F), with_components(9, 0.2F)));
}

TEST(GateRules, AntialiasedEdgesAreLeftOutByPixelmatchOnly) {
  // A vertical edge between flat areas; one picture has a pixel of in-between colour on it.
  Image sharp = grey(0.1F);
  for (int y = 0; y < 100; ++y) std::fill(sharp.pixel(50, y), sharp.pixel(99, y) + 3, 0.9F);
  Image soft = sharp;
  std::fill(soft.pixel(50, 40), soft.pixel(50, 40) + 3, 0.4F);
  EXPECT_TRUE(passes("pixelmatch", sharp, soft));
  EXPECT_FALSE(passes("odiff", sharp, soft));
  EXPECT_FALSE(passes("pixelmatch", grey(0.1F), sharp));
}

TEST(OurGate, PassesTheRightPictureHoweverItIsHeld) {
  const Subject s = subject_of("shadow.sdf");
  EXPECT_EQ(our_verdict(s, s.right, Made::in_double), OurVerdict::passes);
  EXPECT_EQ(our_verdict(s, decoded_8_bits(s.right, true), Made::bits8_rounded), OurVerdict::passes);
  EXPECT_EQ(our_verdict(s, decoded_8_bits(s.right, false), Made::bits8_truncated), OurVerdict::passes);
  textbook::RenderJob job = s.job;
  job.real = textbook::RealType::float32;
  EXPECT_EQ(our_verdict(s, textbook::render(s.scene, s.camera, job), Made::in_float), OurVerdict::passes);
}

TEST(OurGate, FailsAFaultHoweverThePictureIsHeld) {
  const Subject s = subject_of("shadow.sdf");
  const Image wrong = faults::render_with(s.scene, s.camera, s.job, {faults::find_fault("pixel-corner")});
  EXPECT_EQ(our_verdict(s, wrong, Made::in_double), OurVerdict::unexplained);
  EXPECT_EQ(our_verdict(s, wrong, Made::in_float), OurVerdict::unexplained);
  EXPECT_EQ(our_verdict(s, wrong, Made::sampled_nearby), OurVerdict::unexplained);
  EXPECT_EQ(our_verdict(s, decoded_8_bits(wrong, false), Made::bits8_truncated), OurVerdict::unexplained);
  EXPECT_EQ(our_verdict(s, decoded_8_bits(s.right, true), Made::in_double), OurVerdict::unexplained)
      << "8 bits, untold";
}

TEST(Experiments, AreMany) {
  std::mt19937 random(1);
  const std::vector<Subject> one{subject_of("combined-still-life.sdf")};
  EXPECT_GE(fault_experiments(one, random).size(), faults::fault_catalogue().size() + 15);
  EXPECT_EQ(benign_experiments(one, random).size(), 9U);
}

TEST(Experiments, EveryParameterIsInSomeScene) {
  std::mt19937 random(1);
  for (const Parameter& parameter : parameters()) {
    int changed = 0;
    for (const char* file : {"combined-still-life.sdf", "combined-everything.sdf", "combined-village.sdf"}) {
      Subject s = subject_of(file);
      changed += parameter.change(s.scene, s.camera, 0.01, random) ? 1 : 0;
    }
    EXPECT_GT(changed, 0) << parameter.name;
  }
}

}  // namespace
}  // namespace plumb::gate_power
