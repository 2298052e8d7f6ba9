// The pipeline as a whole: raycast, trace and shade, composites, depth, shadows, the table of formulas.
#include <gtest/gtest.h>

#include "tests/support/random_scene.hpp"
#include "tracer/scene/reader.hpp"
#include "tracer/scene/writer.hpp"
#include "tracer/textbook/render.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::textbook {
namespace {

Scene scene_of(const std::string& text) {
  ReadResult result = read_scene(text);
  for (const Finding& finding : result.findings) {
    EXPECT_EQ(finding.severity, Severity::warning) << to_string(finding, "scene");
  }
  return std::move(result.scene);
}

/// Materials that shine by themselves, so that a colour tells which object is seen.
const std::string flat =
    "define material red 1 0 0 0 0 0 0 0 0 1\n"
    "define material green 0 1 0 0 0 0 0 0 0 1\n"
    "define material blue 0 0 1 0 0 0 0 0 0 1\n"
    "define material mirror 0 0 0 0 0 0 0 0 0 1 mirror 0.5 0.5 0.5\n"
    "define material clear 0 0 0 0 0 0 0 0 0 1 transmit 0.5 0.5 0.5\n"
    "ambient 1 1 1\n";

Rgbd pixel(const std::string& text, RenderOptions options = {}, int x = 50, int y = 50,
           const FormulaTable<double>& formulas = {}) {
  const Scene scene = scene_of(text);
  const World<double> world(scene, formulas);
  return Tracer<double>(world, scene.cameras.front(), 101, 101, options).raycast(x, y);
}

TEST(Textbook, TheNearestHitIsSeenWhateverTheOrder) {
  const std::string near = "define shape sphere near 0 0 -5 1 red\n";
  const std::string far = "define shape sphere far 0 0 -9 2 green\n";
  EXPECT_EQ(pixel(flat + near + far), Rgbd(1, 0, 0));
  EXPECT_EQ(pixel(flat + far + near), Rgbd(1, 0, 0));
}

TEST(Textbook, AMissIsTheBackground) {
  EXPECT_EQ(pixel(flat + "background 0.1 0.2 0.3\ndefine shape sphere behind 0 0 5 1 red\n"),
            Rgbd(0.1, 0.2, 0.3));
}

TEST(Textbook, TheLastLevelIsBlackAndNotTheBackground) {
  const std::string text = flat + "background 1 1 1\ndefine shape box wall -9 -9 -6 9 9 -5 mirror\n";
  RenderOptions options;
  options.depth = 1;
  EXPECT_EQ(pixel(text, options), Rgbd(0)) << "the mirrored ray has depth 1";
  options.depth = 2;
  EXPECT_EQ(pixel(text, options), Rgbd(0.5)) << "and now sees the background behind the eye";
}

TEST(Textbook, AnIndexOfOneNeitherBendsNorCountsAsALevel) {
  // Two clear boxes one behind the other are four surfaces; each weighs 1/2.
  const std::string text = flat + "background 1 1 1\ndefine shape box a -9 -9 -6 9 9 -5 clear\n" +
                           "define shape box b -9 -9 -8 9 9 -7 clear\n";
  RenderOptions options;
  options.depth = 2;
  EXPECT_EQ(pixel(text, options), Rgbd(1.0 / 16));
  options.depth = 1;
  EXPECT_EQ(pixel(text, options), Rgbd(0)) << "black where the next level would not exist";
}

TEST(Textbook, TotalReflectionWeighsOneAndReplacesTheMirror) {
  // From inside glass of index 2 the floor is met at 45 degrees, beyond the critical angle of 30.
  const std::string text =
      flat +
      "define material glass 0 0 0 0 0 0 0 0 0 1 mirror 0.1 0.1 0.1 transmit 0.1 0.1 0.1 eta 2\n"
      "define shape box tank -5 -1 -20 5 9 5 glass\n"
      "define shape box target -5 2 -8.9 5 8 -7 green\n"
      "define camera eye 1 0 0 0 0 -1 -1 0 1 0\n";
  EXPECT_EQ(pixel(text), Rgbd(0, 1, 0)) << "neither kr nor kt is applied";
}

TEST(Textbook, TheThreeShadowsOfGlass) {
  const std::string text =
      "define material matt 0 0 0 1 1 1 0 0 0 1\n"
      "define material glass 0 0 0 0 0 0 0 0 0 1 transmit 0.5 1 0.25\n"
      "define shape box floor -9 -2 -20 9 -1 0 matt\n"
      "define shape box pane -9 1 -20 9 2 0 glass\n"
      "define light lamp 0 100 -6 1 1 1 1\n"
      "define camera eye 40 0 0 0 0 -0.2 -1 0 1 0\n";
  RenderOptions options;
  options.glass_shadow = GlassShadow::none;
  const Rgbd lit = pixel(text, options);
  EXPECT_GT(lit.x, 0.9);
  options.glass_shadow = GlassShadow::filtered;
  // because the pane has two surfaces, each takes kt; the products of powers of two are exact
  EXPECT_EQ(pixel(text, options), lit * Rgbd(0.25, 1, 0.0625));
  options.glass_shadow = GlassShadow::full;
  EXPECT_EQ(pixel(text, options), Rgbd(0));
}

TEST(Textbook, ASharedChildIsTheSameAsTwoShapesWrittenFlat) {
  const std::string shared = flat +
                             "define shape sphere ball 0 0 0 1 red\n"
                             "define shape composite left ball\ndefine shape composite right ball\n"
                             "transform left translate -1.5 0 -6\n"
                             "transform right scale 1 2 1\ntransform right translate 1.5 0 -6\n";
  const std::string written = flat +
                              "define shape sphere a 0 0 0 1 red\ndefine shape sphere b 0 0 0 1 red\n"
                              "transform a translate -1.5 0 -6\n"
                              "transform b scale 1 2 1\ntransform b translate 1.5 0 -6\n";
  RenderJob job;
  job.width = 40;
  job.height = 30;
  const Scene dag = scene_of(shared);
  const Scene tree = scene_of(written);
  const Image image = render(dag, dag.cameras.front(), job);
  EXPECT_EQ(image.rgb, render(tree, tree.cameras.front(), job).rgb);
  EXPECT_NE(image.pixel(9, 15)[0], 0) << "or nothing was seen at all";
}

TEST(Textbook, TIsComparedInOneSpace) {
  // In its own space the big far sphere is met at a smaller t, if the direction was normalised there.
  const std::string text = flat +
                           "define shape sphere far 0 0 0 0.1 green\ntransform far scale 50\n"
                           "transform far translate 0 0 -20\n"
                           "define shape sphere near 0 0 0 100 red\ntransform near scale 0.01\n"
                           "transform near translate 0 0 -5\n";
  EXPECT_EQ(pixel(text), Rgbd(1, 0, 0));
}

TEST(Textbook, ThePictureDoesNotDependOnTheThreads) {
  const Scene scene = tests::random_scene(7).scene;
  RenderJob job;
  job.width = 64;
  job.height = 48;
  job.threads = 1;
  const Image one = render(scene, scene.cameras.front(), job);
  for (const int threads : {2, 7}) {
    job.threads = threads;
    EXPECT_EQ(render(scene, scene.cameras.front(), job).rgb, one.rgb) << threads;
  }
}

TEST(Textbook, TheTableOfTheLectureGivesTheSamePictureAsTheInlinedFormulas) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const tests::RandomScene random = tests::random_scene(seed);
    const Camera& camera = random.scene.cameras.front();
    RenderJob job;
    job.width = 16;
    job.height = 12;
    job.options = random.options;
    const Image inlined = render(random.scene, camera, job);
    const World<double> world(random.scene, FormulaTable<double>{});
    const Tracer<double> tracer(world, camera, 16, 12, random.options);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 16; ++x) {
        const Rgbd colour = tracer.raycast(x, y);
        for (int c = 0; c < 3; ++c) EXPECT_EQ(static_cast<float>(colour[c]), inlined.pixel(x, y)[c]) << seed;
      }
    }
  }
}

TEST(Textbook, EveryRealTypeGivesTheSamePictureButForEdges) {
  const Scene scene = scene_of(
      "define material matt 0.2 0.2 0.2 0.6 0.4 0.2 0.2 0.2 0.2 20 mirror 0.2 0.2 0.2\n"
      "define shape sphere ball 0 0 -5 1 matt\ndefine shape box floor -9 -3 -20 9 -2 5 matt\n"
      "define light lamp 5 9 1 1 1 1 0.8\nambient 0.3 0.3 0.3\n");
  RenderJob job;
  job.width = 60;
  job.height = 40;
  const Image reference = render(scene, scene.cameras.front(), job);
  for (const auto& [real, tolerance, pixels] :
       // because float has 24 bits and shading needs some 50 roundings; at edges whole pixels may flip
       {std::tuple(RealType::float32, 5e-5, 12), std::tuple(RealType::long_double, 1e-7, 0)}) {
    job.real = real;
    const Image other = render(scene, scene.cameras.front(), job);
    int off = 0;
    for (std::size_t i = 0; i < other.rgb.size(); ++i)
      off += std::abs(other.rgb[i] - reference.rgb[i]) > tolerance ? 1 : 0;
    EXPECT_LE(off, 3 * pixels);
  }
}

std::optional<double> no_sphere(const Ray<double>&, const Vec3<double>&, double, bool) {
  return std::nullopt;
}
bool never_blocks(double, double) { return false; }

TEST(FormulaTable, OneEntryCanBeReplacedAndNothingElseChanges) {
  const std::string text =
      flat + "define shape sphere ball 0 0 -5 1 red\ndefine shape box wall -9 -9 -9 9 9 -8 green\n";
  FormulaTable<double> table;
  table.intersect_sphere = &no_sphere;
  EXPECT_EQ(pixel(text), Rgbd(1, 0, 0));
  EXPECT_EQ(pixel(text, {}, 50, 50, table), Rgbd(0, 1, 0)) << "the box is still there";
}

TEST(FormulaTable, AShadowCanBeTakenAway) {
  const std::string text =
      "define material matt 0 0 0 1 1 1 0 0 0 1\n"
      "define shape box floor -9 -2 -20 9 -1 0 matt\ndefine shape box lid -9 1 -20 9 2 0 matt\n"
      "define light lamp 0 100 -6 1 1 1 1\ndefine camera eye 40 0 0 0 0 -0.2 -1 0 1 0\n";
  FormulaTable<double> table;
  table.blocks_light = &never_blocks;
  EXPECT_EQ(pixel(text), Rgbd(0));
  EXPECT_GT(pixel(text, {}, 50, 50, table).x, 0.9);
}

TEST(FormulaTable, ABlockerBeyondTheLightIsAskedForByTheFormulaAlone) {
  // The commonest mistake of real tracers: what lies behind the light casts a shadow, too.
  const std::string text =
      "define material matt 0 0 0 1 1 1 0 0 0 1\n"
      "define shape box floor -9 -2 -20 9 -1 0 matt\ndefine shape box lid -9 5 -20 9 6 0 matt\n"
      "define light lamp 0 2 -6 1 1 1 1\ndefine camera eye 40 0 0 0 0 -0.2 -1 0 1 0\n";
  FormulaTable<double> table;
  table.blocks_light = [](double t, double) { return t > 0; };
  EXPECT_GT(pixel(text).x, 0.5);
  EXPECT_EQ(pixel(text, {}, 50, 50, table), Rgbd(0));
}

}  // namespace
}  // namespace plumb::textbook
