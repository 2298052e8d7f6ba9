// The engine against the textbook tracer: each is the other's check.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "references/attribution.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/run.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/scene/reader.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

using engine::Settings;

RenderJob small(const RenderOptions& options) {
  RenderJob job;
  job.width = 45;  // neither a multiple of a tile nor of a vector
  job.height = 30;
  job.options = options;
  job.threads = 1;
  return job;
}

/// Pixels over 1e-6 that nothing excuses: both tracers round a pixel's float32 alike but for a few ulp,
/// because they evaluate the same formulas in double; what differs by more must be a tie.
std::size_t unexplained(const Scene& scene, const Camera& camera, const RenderJob& job, const Image& engine) {
  const Image textbook = textbook::render(scene, camera, job);
  return references::attribute({scene, camera, job.options, textbook, engine, 1e-6,
                                references::Precision::float32, references::Judge::baseline})
      .count(references::Cause::unexplained);
}

int seeds(int usual) {
  const char* count = std::getenv("PLUMB_RANDOM_SCENES");
  return count == nullptr ? usual : std::max(usual, std::atoi(count));
}

/// Everything that the engine can choose, chosen otherwise than it would for these small scenes.
std::vector<Settings> all_settings() {
  return {{}, {widest_vectors(), 65536, 0}, {widest_vectors(), 0, 64}, {widest_vectors(), 0, 0}};
}

TEST(Engine, RandomScenesAgreeWithTheTextbookTracer) {
  for (int seed = 1; seed <= seeds(150); ++seed) {
    const RandomScene random = random_scene(static_cast<unsigned>(seed));
    const Camera& camera = random.scene.cameras.front();
    const RenderJob job = small(random.options);
    for (const Settings& settings : all_settings()) {
      const Image image = engine::render(random.scene, camera, job, nullptr, settings);
      ASSERT_EQ(unexplained(random.scene, camera, job, image), 0)
          << "seed " << seed << ", written out up to " << settings.most_written_out << ", few objects up to "
          << settings.few_objects;
    }
  }
}

TEST(Engine, GlassShadowsAgreeWithTheTextbookTracer) {
  for (int seed = 1; seed <= 60; ++seed) {
    const RandomScene random = random_scene(static_cast<unsigned>(seed));
    for (const GlassShadow shadow : {GlassShadow::full, GlassShadow::none, GlassShadow::filtered}) {
      RenderJob job = small(random.options);
      job.options.glass_shadow = shadow;
      job.options.shadows = seed % 10 != 0;
      const Image image = engine::render(random.scene, random.scene.cameras.front(), job);
      ASSERT_EQ(unexplained(random.scene, random.scene.cameras.front(), job, image), 0) << "seed " << seed;
    }
  }
}

TEST(Engine, ScenesOfTheProjectAgreeWithTheTextbookTracer) {
  for (const auto& file : fs::directory_iterator(source_path("tests/scenes"))) {
    if (file.path().extension() != ".sdf") continue;
    const Scene scene = load_scene(file.path().string(), Dialect{});
    const Camera& camera = scene.camera(scene.renders.front().camera);
    const RenderJob job = small({});
    EXPECT_EQ(unexplained(scene, camera, job, engine::render(scene, camera, job)), 0) << file.path();
  }
}

TEST(Engine, ThePictureIsTheSameForAllThreadsAndVectors) {
  for (int seed = 1; seed <= 40; ++seed) {
    const RandomScene random = random_scene(static_cast<unsigned>(seed));
    const Camera& camera = random.scene.cameras.front();
    for (const RealType real : {RealType::float64, RealType::float32}) {
      RenderJob job = small(random.options);
      job.real = real;
      const Image image = engine::render(random.scene, camera, job, nullptr, {Vectors::any});
      for (const Vectors vectors : {Vectors::any, Vectors::avx2, Vectors::avx512}) {
        if (vectors > widest_vectors()) continue;
        for (const int threads : {1, 2, 5}) {
          job.threads = threads;
          ASSERT_EQ(engine::render(random.scene, camera, job, nullptr, {vectors}).rgb, image.rgb)
              << "seed " << seed << ", " << name_of(vectors) << ", " << threads << " threads";
        }
      }
    }
  }
}

/// A tile is a square of the picture: a part of the picture that begins elsewhere has other tiles.
TEST(Engine, ThePictureDoesNotDependOnWhatIsTracedTogether) {
  for (int seed = 1; seed <= 40; ++seed) {
    const RandomScene random = random_scene(static_cast<unsigned>(seed));
    const Camera& camera = random.scene.cameras.front();
    const RenderJob job = small(random.options);
    const Image image = engine::render(random.scene, camera, job);
    for (const Settings& settings : all_settings()) {
      if (settings.most_written_out == 0)
        continue;  // shared groups have matrices that are composed otherwise
      ASSERT_EQ(engine::render(random.scene, camera, job, nullptr, settings).rgb, image.rgb)
          << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace plumb::tests
