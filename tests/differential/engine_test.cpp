// The engine against the textbook tracer: each is the other's check.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "references/attribution/attribution.hpp"
#include "references/comparison/comparison.hpp"
#include "references/renderers/ours.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/run.hpp"
#include "tests/support/seeds.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/engine/samples.hpp"
#include "tracer/format/reader.hpp"
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
  return attribution::attribute({{scene, camera, job.width, job.height, job.options},
                                 textbook,
                                 engine,
                                 1e-6,
                                 renderers::own_resolution()})
      .count(attribution::Cause::unexplained);
}

/// Everything that the engine can choose, chosen otherwise than it would for these small scenes.
std::vector<Settings> all_settings() {
  return {{}, {widest_vectors(), 65536, 0}, {widest_vectors(), 0, 64}, {widest_vectors(), 0, 0}};
}

TEST(Engine, RandomScenesAgreeWithTheTextbookTracer) {
  const unsigned seeds = number_from("PLUMB_RANDOM_SCENES", 150);
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const RandomScene random = random_scene(seed);
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
  const unsigned seeds = number_from("PLUMB_RANDOM_SCENES", 60);
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const RandomScene random = random_scene(seed);
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

/// The engine has a power function of its own.
TEST(Engine, HighlightsOfAllSizesAgreeWithTheTextbookTracer) {
  for (const char* m : {"0", "0.001", "1", "1.5", "300", "100000", "10000000"}) {
    const ReadResult read =
        read_scene("define material shiny 0 0 0 0.2 0.1 0 1 0.9 0.8 " + std::string(m) +
                   "\ndefine shape sphere ball 0 0 -3 1 shiny\ndefine light l 0.3 0.2 5 1 1 1 1\n");
    ASSERT_FALSE(read.has_errors()) << m;
    const Camera& camera = read.scene.cameras.front();
    const RenderJob job = small({});
    const Image image = engine::render(read.scene, camera, job);
    EXPECT_EQ(unexplained(read.scene, camera, job, image), 0) << m;
    EXPECT_GT(*std::max_element(image.rgb.begin(), image.rgb.end()), 0.1F) << m << ": nothing is seen";
  }
}

/// Tiles that no object is seen in are not traced: neither must they be taken for such.
TEST(Engine, SpecksAreSeenInTheTilesThatTheyAreIn) {
  std::string text = "define material red 1 0 0 0 0 0 0 0 0 1\nambient 1 1 1\n";
  for (int i = 0; i < 40; ++i) {  // 19 pixels apart: in any part of a tile
    text += "define shape sphere s" + std::to_string(i) + " " + std::to_string(0.23 * (i % 8 - 3.5)) + " " +
            std::to_string(0.23 * (i / 8 - 2)) + " -3 0.009 red\n";
  }
  const ReadResult read = read_scene(text);
  ASSERT_FALSE(read.has_errors());
  RenderJob job = small({});
  job.width = 203;
  job.height = 141;
  const Camera& camera = read.scene.cameras.front();
  const Image image = engine::render(read.scene, camera, job);
  EXPECT_EQ(unexplained(read.scene, camera, job, image), 0);
  EXPECT_GE(std::count(image.rgb.begin(), image.rgb.end(), 1.0F), 10) << "specks are not seen";
}

/// A sphere of 1/2500 of its distance: half_b^2 - c would lose half of a float's digits there.
TEST(Engine, FloatIsGoodToItsLastDigitsOnSmallSpheres) {
  const ReadResult read = read_scene(
      "define material white 0 0 0 0.9 0.9 0.9 0 0 0 1\ndefine shape sphere speck 0 0 -10 0.004 white\n"
      "define light l 0.3 0.2 5 1 1 1 1\ndefine camera eye 0.05\nrender eye speck.ppm 45 30\n");
  ASSERT_FALSE(read.has_errors());
  RenderJob job = small({});
  const Image right = engine::render(read.scene, read.scene.camera("eye"), job);
  job.real = RealType::float32;
  const Image image = engine::render(read.scene, read.scene.camera("eye"), job);
  // Because a float has 24 bits and the hit's place is known to an ulp of its distance, 2500 radii.
  EXPECT_LE(comparison::compare(image, right, 2500 * 0x1p-23).pixels_over, 4U) << "beyond the silhouette";
  EXPECT_GT(*std::max_element(right.rgb.begin(), right.rgb.end()), 0.5F) << "nothing is seen";
}

/// Of surfaces that coincide one is crossed, from the front, from inside and at grazing angles: glass that is
/// there twice is the glass that is there once.
TEST(Engine, GlassThatIsThereTwiceIsCrossedOnceByBothTracers) {
  const std::string once = R"(camera eye 60
define light key 3 6 4 0.9 0.9 0.8 1
ambient 0.4 0.4 0.4
background 0.1 0.15 0.2
define material red 0.2 0.05 0.05 0.6 0.2 0.1 0.3 0.3 0.3 20
define material glass 0.1 0.1 0.3 0.2 0.1 0.1 0.2 0.2 0.2 10 mirror 0.1 0.1 0.1 transmit 0.7 0.8 0.8 eta 1.3
define shape box floor -9 -2 -20 9 -1.9 3 red
define shape sphere big 0 -1 -10 3.5 glass
define shape sphere small 0.5 -0.5 -3 0.6 glass
define shape composite one big small
)";
  const Scene single = read_scene(once).scene,
              twice = read_scene(once + "define shape composite two big small\n").scene;
  RenderJob job = small({});
  job.width = 96;
  job.height = 72;
  const Image expected = textbook::render(single, single.cameras.front(), job);
  const auto over = [&](const Image& image) { return comparison::pixels_over(expected, image, 1e-6).size(); };
  EXPECT_EQ(over(textbook::render(twice, twice.cameras.front(), job)), 0U);
  EXPECT_EQ(over(engine::render(single, single.cameras.front(), job)), 0U);
  EXPECT_EQ(over(engine::render(twice, twice.cameras.front(), job)), 0U);
  job.real = RealType::long_double;
  EXPECT_EQ(over(textbook::render(twice, twice.cameras.front(), job)), 0U);
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

/// With other limits, bundles hold other rays.
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

/// The grid of 3 x 3 samples are the pixel centres of a picture three times as large.
TEST(Engine, AGridOfSamplesIsALargerPictureAveraged) {
  const RandomScene random = random_scene(7);
  const Camera& camera = random.scene.cameras.front();
  RenderJob job = small(random.options);
  job.samples = 9;
  const Image sampled = engine::render(random.scene, camera, job);
  job.samples = 1;
  job.width *= 3;
  job.height *= 3;
  const Image large = textbook::render(random.scene, camera, job);
  for (int y = 0; y < sampled.height; ++y) {
    for (int x = 0; x < sampled.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int k = 0; k < 9; ++k) sum += static_cast<double>(large.pixel(3 * x + k % 3, 3 * y + k / 3)[c]);
        // The larger picture is of float32: nine roundings of values below 4.
        ASSERT_NEAR(sampled.pixel(x, y)[c], sum / 9, 1e-6) << x << " " << y;
      }
    }
  }
}

TEST(Engine, EveryPatternFillsThePixelEvenlyAndOneSampleIsItsCentre) {
  for (const SamplePattern pattern : {SamplePattern::grid, SamplePattern::low_discrepancy}) {
    const auto one = engine::sample_points(1, pattern);
    EXPECT_EQ(one.front().x, 0.5);
    EXPECT_EQ(one.front().y, 0.5);
    for (const int count : {4, 16, 25, 100}) {
      const auto points = engine::sample_points(count, pattern);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
      // A box anchored at the corner holds its share of the points, but for a few: the star discrepancy of
      // Hammersley's points is below (log2 n + 2) / n, a grid's below 2 / sqrt n.
      const double bound =
          pattern == SamplePattern::grid ? 2 / std::sqrt(count) : (std::log2(count) + 2) / count;
      for (int i = 1; i <= 20; ++i) {
        for (int j = 1; j <= 20; ++j) {
          const double x = 0.05 * i, y = 0.05 * j;
          int inside = 0;
          for (const auto& point : points) inside += point.x < x && point.y < y ? 1 : 0;
          ASSERT_NEAR(inside / static_cast<double>(count), x * y, bound) << count << ": " << x << " " << y;
        }
      }
    }
  }
  EXPECT_THROW(engine::sample_points(5, SamplePattern::grid), std::invalid_argument);
}

TEST(Engine, TheTextbookTracerRefusesSamples) {
  const RandomScene random = random_scene(1);
  RenderJob job = small(random.options);
  job.samples = 4;
  EXPECT_THROW(textbook::render(random.scene, random.scene.cameras.front(), job), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::tests
