// Every pixel of random scenes, ours against the oracle: nowhere may ours be wrong. POV-Ray is not needed.
#include <gtest/gtest.h>

#include "references/renderers/ours.hpp"
#include "references/renderers/povray.hpp"
#include "references/report/sentences.hpp"
#include "references/truth/judgement.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/seeds.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/format/writer.hpp"

namespace plumb::tests {
namespace {

using renderers::OwnTracer;
using truth::Judgement;
using truth::Verdict;

/// PLUMB_JUDGED_SCENES says how many, PLUMB_JUDGED_WIDTH how large; three quarters as high.
TEST(JudgedScenes, OursIsNowhereWrong) {
  const unsigned wanted = number_from("PLUMB_JUDGED_SCENES", 30);
  const auto width = static_cast<int>(number_from("PLUMB_JUDGED_WIDTH", 16));
  constexpr double enough = 1e12;
  std::size_t undecided = 0;
  std::size_t pixels = 0;
  for (unsigned seed = 1; seed <= wanted; ++seed) {
    const RandomScene random = random_scene(seed);
    const Scene scene = read_scene(write_scene(random.scene)).scene;
    const Camera& camera = scene.cameras.front();
    RenderJob job;
    job.width = width;
    job.height = width * 3 / 4;
    job.options = random.options;
    job.real = RealType::quad;
    const Image oracle = renderers::render(OwnTracer::textbook, scene, camera, job);
    job.real = RealType::float64;
    for (const OwnTracer renderer : {OwnTracer::textbook, OwnTracer::engine}) {
      const Image ours = renderers::render(renderer, scene, camera, job);
      const Judgement judgement =
          truth::judge_pixels({{scene, camera, ours.width, ours.height, random.options},
                               oracle,
                               ours,
                               1e-6,
                               renderers::povray_resolution()},
                              enough);
      EXPECT_EQ(judgement.pixels.size(), judgement.count(Verdict::undecided))
          << "seed " << seed << ": " << report::note_of(judgement);
      EXPECT_EQ(judgement.not_judged, 0U) << "seed " << seed << ": " << report::note_of(judgement);
      undecided += judgement.count(Verdict::undecided);
      pixels += oracle.rgb.size() / 3;
    }
  }
  RecordProperty("pixels", std::to_string(pixels));
  RecordProperty("undecided", std::to_string(undecided));
}

}  // namespace
}  // namespace plumb::tests
