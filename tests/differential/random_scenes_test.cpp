// Random scenes with every feature, against POV-Ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "exporters/povray.hpp"
#include "references/gates/verify.hpp"
#include "references/renderers/ours.hpp"
#include "references/report/sentences.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/run.hpp"
#include "tests/support/seeds.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/format/writer.hpp"

namespace plumb::tests {
namespace {

using gates::SceneResult;
using gates::Status;
using renderers::OwnTracer;

/// Read back from its own text, exported, and rendered small in double and float by both tracers.
TEST(RandomScenes, NeverCrash) {
  const unsigned wanted = number_from("PLUMB_RANDOM_SMOKE", 300);
  for (unsigned seed = 1; seed <= wanted; ++seed) {
    const RandomScene random = random_scene(seed);
    const ReadResult read = read_scene(write_scene(random.scene));
    ASSERT_FALSE(read.has_errors()) << "seed " << seed;
    const Camera& camera = read.scene.cameras.front();
    EXPECT_FALSE(exporters::export_povray({read.scene, camera, 16, 12, random.options}).text.empty());
    RenderJob job;
    job.width = 16;
    job.height = 12;
    job.options = random.options;
    job.threads = 1;
    for (const auto real : {RealType::float64, RealType::float32}) {
      job.real = real;
      for (const OwnTracer renderer : {OwnTracer::textbook, OwnTracer::engine}) {
        const Image image = renderers::render(renderer, read.scene, camera, job);
        EXPECT_TRUE(std::all_of(image.rgb.begin(), image.rgb.end(), [](float c) { return std::isfinite(c); }))
            << "seed " << seed;
      }
    }
  }
}

TEST(RandomScenes, AgreeWithPovrayOnEveryPixel) {
  const Workplace workplace;
  setenv("PLUMB_CACHE", workplace.path(".cache").c_str(), 1);
  using OptionsKey = std::pair<int, GlassShadow>;
  std::map<OptionsKey, std::vector<std::string>> scenes;
  const unsigned wanted = number_from("PLUMB_RANDOM_SCENES", 60);
  for (unsigned seed = 1; seed <= wanted; ++seed) {
    const RandomScene random = random_scene(seed);
    scenes[{random.options.depth, random.options.glass_shadow}].push_back(
        workplace.file(std::to_string(seed) + ".sdf", write_scene(random.scene)));
  }
  std::size_t agreed = 0;
  for (const auto& [options, paths] : scenes) {
    gates::VerifyOptions verify;
    verify.render.depth = options.first;
    verify.render.glass_shadow = options.second;
    const auto report = gates::verify(paths, verify, {});
    ASSERT_TRUE(report.notice.empty()) << report.notice;
    for (const SceneResult& result : report.scenes) {
      EXPECT_EQ(result.status, Status::agree)
          << result.scene << " depth " << options.first << ": " << result.comparison.pixels_over
          << " pixels over, " << report::message_of(result) << "\n"
          << read_file(result.scene);
      EXPECT_EQ(result.budget.unverified(), 0U) << result.scene << ": " << report::message_of(result);
      agreed += result.status == Status::agree ? 1 : 0;
    }
  }
  EXPECT_EQ(agreed, wanted);
}

}  // namespace
}  // namespace plumb::tests
