// Verifying scenes against POV-Ray: verdicts, the cache, and what is excused as a tie and what never is.
#include "references/gates/verify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>

#include "references/renderers/cache.hpp"
#include "references/renderers/povray.hpp"
#include "references/report/sentences.hpp"
#include "tests/support/end_to_end.hpp"
#include "tests/support/run.hpp"
#include "tests/support/variable.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

using gates::SceneResult;
using gates::Status;
using gates::VerifyOptions;
using gates::VerifyReport;

const std::string materials = R"(
define material red 0.2 0.05 0.05 0.6 0.2 0.1 0.3 0.3 0.3 20
define material blue 0.05 0.1 0.3 0.1 0.3 0.6 0.2 0.2 0.2 10
define light key 3 6 4 0.9 0.9 0.8 1
ambient 0.4 0.4 0.4
background 0.1 0.15 0.2
define camera eye 60
define camera other 30
render eye image.ppm 48 36
)";
const std::string ball = materials + "define shape sphere ball 0.1 0.2 -4 1.1 red\n";
const std::string block =
    materials + "define shape box block -1.1 -0.8 -6 0.9 1 -4 blue\ntransform block rotate 5 1 1 0\n";

/// The fronts of two boxes share a plane; which of them is seen where both are is chance. (A full turn is not
/// quite the identity, so that it is rounded otherwise in each renderer.)
std::string coincident(const std::string& first, const std::string& second) {
  return materials + "define shape box one -1.3 -0.7 -6 0.4 0.9 -4 " + first +
         "\ndefine shape box two -0.5 -0.9 0 1.2 0.6 0.3 " + second +
         "\ntransform two rotate 360 0 0 1\ntransform two translate 0 0 -4.3\n";
}

/// A box of glass that stands on a floor.
const std::string glass_on_floor = materials + R"(
define material glass 0 0 0 0 0 0 0.2 0.2 0.2 10 transmit 0.8 0.8 0.8 eta 1.5
define shape box stone -0.6 -1 -5 0.7 0.3 -4 glass
define shape box floor -3.1 -1.5 -9 3.3 -1 0 red
)";

/// Scenes and a cache of their own.
class Verify : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    return workplace_.file(name, text);
  }
  std::string path(const std::string& name) const { return workplace_.path(name); }

 private:
  Workplace workplace_;
  Variable cache_{"PLUMB_CACHE", workplace_.path(".cache")};
};

std::vector<Status> statuses(const VerifyReport& report) {
  std::vector<Status> all;
  for (const SceneResult& result : report.scenes) all.push_back(result.status);
  return all;
}

TEST_F(Verify, NoBadSceneStopsTheOthersAndResultsKeepTheirOrder) {
  const std::vector<std::string> scenes{file("a.sdf", ball), path("missing.sdf"),
                                        file("broken.sdf", "define shape sphere ball 0 0\n"),
                                        file("b.sdf", block)};
  std::vector<std::string> told;
  const VerifyReport report =
      gates::verify(scenes, {}, [&](const SceneResult& result) { told.push_back(result.scene); });
  EXPECT_EQ(statuses(report), (std::vector{Status::agree, Status::error, Status::error, Status::agree}));
  EXPECT_EQ(report.exit_code(), 2);
  EXPECT_EQ(told, scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) EXPECT_EQ(report.scenes[i].scene, scenes[i]);
  EXPECT_TRUE(contains(report::message_of(report.scenes[1]), "missing.sdf"))
      << report::message_of(report.scenes[1]);
  EXPECT_TRUE(contains(report::message_of(report.scenes[2]), "broken.sdf:1"))
      << report::message_of(report.scenes[2]);
  EXPECT_EQ(report.scenes[0].width, 48);
  EXPECT_EQ(report.scenes[0].height, 36);
  EXPECT_EQ(report.scenes[0].comparison.pixels, 48U * 36);
  EXPECT_GT(report.scenes[0].seconds_reference, 0);
  EXPECT_FALSE(report.reference_version.empty());
  EXPECT_EQ(report.notice, "");
}

TEST_F(Verify, ScenesThatAllAgreeGiveZeroAndTheSecondRunIsCached) {
  const std::vector<std::string> scenes{file("a.sdf", ball), file("b.sdf", block)};
  const VerifyReport first = gates::verify(scenes, {}, {});
  const VerifyReport second = gates::verify(scenes, {}, {});
  EXPECT_EQ(first.exit_code(), 0);
  EXPECT_EQ(second.exit_code(), 0);
  EXPECT_EQ(first.reference_version, second.reference_version);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    EXPECT_FALSE(first.scenes[i].cached);
    EXPECT_TRUE(second.scenes[i].cached);
    EXPECT_EQ(first.scenes[i].comparison.max_error, second.scenes[i].comparison.max_error);
    EXPECT_EQ(second.scenes[i].seconds_reference, 0);
  }
}

TEST_F(Verify, TheResultsAreTheSameForEveryNumberOfJobs) {
  std::vector<std::string> scenes;
  for (int i = 0; i < 5; ++i) {
    scenes.push_back(file(std::to_string(i), i % 2 == 0 ? ball : materials + "nonsense\n"));
  }
  for (const int jobs : {1, 2, 9}) {
    VerifyOptions options;
    options.jobs = jobs;
    std::vector<std::string> told;
    const VerifyReport report =
        gates::verify(scenes, options, [&](const SceneResult& result) { told.push_back(result.scene); });
    EXPECT_EQ(told, scenes) << jobs;
    EXPECT_EQ(statuses(report),
              (std::vector{Status::agree, Status::error, Status::agree, Status::error, Status::agree}))
        << jobs;
  }
}

TEST_F(Verify, NoSceneAtAllIsNoTrouble) {
  const VerifyReport report = gates::verify({}, {}, {});
  EXPECT_EQ(report.exit_code(), 0);
  EXPECT_TRUE(report.scenes.empty());
}

TEST_F(Verify, SizeAndCameraMayBeOthersThanTheScenes) {
  const std::string scene = file("a.sdf", ball);
  VerifyOptions options;
  options.size = Size{20, 30};
  options.camera = "other";
  const VerifyReport report = gates::verify({scene}, options, {});
  EXPECT_EQ(report.exit_code(), 0) << report::message_of(report.scenes[0]);
  EXPECT_EQ(report.scenes[0].width, 20);
  EXPECT_EQ(report.scenes[0].height, 30);
  options.camera = "nobody";
  const VerifyReport unknown = gates::verify({scene}, options, {});
  EXPECT_EQ(unknown.exit_code(), 2);
  EXPECT_TRUE(contains(report::message_of(unknown.scenes[0]), "nobody"))
      << report::message_of(unknown.scenes[0]);
}

TEST_F(Verify, WarningsOfPovrayReachTheMessage) {
  const VerifyReport report =
      gates::verify({file("empty.sdf", "define camera eye 60\nrender eye image.ppm 16 12\n")}, {}, {});
  EXPECT_EQ(report.exit_code(), 0) << report::message_of(report.scenes[0]);
  EXPECT_TRUE(contains(report::message_of(report.scenes[0]), "POV-Ray warns"))
      << report::message_of(report.scenes[0]);
}

TEST_F(Verify, ATimeLimitThatIsTooShortIsAnErrorOfThatScene) {
  VerifyOptions options;
  options.reference.time_limit_seconds = 0.05;
  const VerifyReport report = gates::verify({file("a.sdf", ball)}, options, {});
  EXPECT_EQ(report.exit_code(), 2);
  EXPECT_TRUE(contains(report::message_of(report.scenes[0]), "longer than"))
      << report::message_of(report.scenes[0]);
}

TEST_F(Verify, WithoutPovrayStoredImagesAreUsedAndThatIsSaid) {
  const Variable nothing_on_path("PATH", path("nowhere"));
  const Variable none_stored("PLUMB_REFERENCES", path("none"));
  const VerifyReport report = gates::verify({file("a.sdf", ball)}, {}, {});
  EXPECT_TRUE(contains(report.notice, "NO POV-RAY IS RUN")) << report.notice;
  EXPECT_EQ(report.exit_code(), 2);
  EXPECT_TRUE(contains(report::message_of(report.scenes[0]), "no stored reference image"))
      << report::message_of(report.scenes[0]);
}

TEST_F(Verify, StoredImagesStartNoPovrayAndThatIsSaid) {
  const Variable none_stored("PLUMB_REFERENCES", path("none"));
  VerifyOptions options;
  options.reference.stored = true;
  const VerifyReport report = gates::verify({file("a.sdf", ball)}, options, {});
  EXPECT_TRUE(contains(report.notice, "--stored")) << report.notice;
  EXPECT_EQ(report.exit_code(), 2);
}

// A picture that is really wrong.

struct Loaded {
  explicit Loaded(const std::string& file) : scene(load_scene(file, {})) {}
  const Camera& camera() const { return scene.cameras.front(); }
  renderers::ExportedShot exported() const {
    return renderers::PovrayRenderer().exported({scene, camera(), 48, 36});
  }
  Image render() const {
    textbook::RenderJob job;
    job.width = 48;
    job.height = 36;
    return textbook::render(scene, camera(), job);
  }
  /// A box of it a little nearer, so that only this is seen where another one coincides with it.
  Loaded with_nearer(std::size_t shape) const {
    Loaded nearer = *this;
    std::get<Box>(nearer.scene.shapes[shape].geometry).max.z += 1e-9;
    return nearer;
  }
  Scene scene;
};

TEST_F(Verify, AWrongPixelMakesItDifferAndIsTold) {
  const std::string scene = file("a.sdf", ball);
  const Loaded loaded(scene);
  const renderers::PovrayRenderer povray;
  const renderers::Cache cache;
  // A doctored reference in the cache: our picture, but for one pixel in the middle of the ball.
  renderers::Rendered doctored;
  doctored.image = loaded.render();
  doctored.image.pixel(25, 16)[1] += 0.01F;
  cache.store(loaded.exported(), cache.version_of(povray), doctored);
  const VerifyReport report = gates::verify({scene, file("b.sdf", block)}, {}, {});
  EXPECT_EQ(statuses(report), (std::vector{Status::differ, Status::agree}));
  EXPECT_EQ(report.exit_code(), 1);
  const SceneResult& result = report.scenes[0];
  EXPECT_TRUE(result.cached);
  EXPECT_EQ(result.comparison.pixels_over, 1U);
  EXPECT_EQ(result.budget.explained(), 0U);
  EXPECT_NEAR(result.comparison.max_error, 0.01, 1e-6);
  EXPECT_EQ(result.comparison.worst.x, 25);
  EXPECT_EQ(result.comparison.worst.y, 16);
  const VerifyReport worse = gates::verify({scene, path("missing")}, {}, {});
  EXPECT_EQ(worse.exit_code(), 2) << "trouble outweighs a difference";
}

TEST_F(Verify, APixelThatIsNotFiniteNeverAgrees) {
  const std::string scene = file("a.sdf", ball);
  const Loaded loaded(scene);
  const renderers::Cache cache;
  renderers::Rendered doctored;
  doctored.image = loaded.render();
  doctored.image.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  cache.store(loaded.exported(), cache.version_of(renderers::PovrayRenderer()), doctored);
  const VerifyReport report = gates::verify({scene}, {}, {});
  EXPECT_EQ(report.exit_code(), 1);
  EXPECT_TRUE(contains(report::message_of(report.scenes[0]), "1 pixels are not finite"))
      << report::message_of(report.scenes[0]);
}

// Ties.

TEST_F(Verify, WhicheverOfCoincidentSurfacesPovrayTakesTheSceneAgrees) {
  const VerifyReport report = gates::verify(
      {file("a.sdf", coincident("red", "blue")), file("b.sdf", coincident("blue", "red"))}, {}, {});
  for (const SceneResult& result : report.scenes) {
    EXPECT_EQ(result.status, Status::agree) << report::message_of(result);
    EXPECT_EQ(result.comparison.pixels_over, result.budget.explained());
    EXPECT_EQ(result.budget.unverified(), 0U) << "the export decides as plumb does";
  }
}

TEST_F(Verify, TiesAreCountedAndTheirShapesNamed) {
  const std::string scene = file("a.sdf", coincident("red", "blue"));
  const Loaded loaded(scene);
  const renderers::Cache cache;
  const std::string version = cache.version_of(renderers::PovrayRenderer());
  const Image ours = loaded.render();
  std::size_t ties = 0;
  for (const std::size_t nearer : {0U, 1U}) {
    // As if POV-Ray had taken the one box, and then the other, wherever both are.
    renderers::Rendered picture;
    picture.image = loaded.with_nearer(nearer).render();
    cache.store(loaded.exported(), version, picture);
    const SceneResult result = gates::verify({scene}, {}, {}).scenes.front();
    const std::size_t over = comparison::pixels_over(picture.image, ours, 1e-6).size();
    ties += over;
    EXPECT_EQ(result.comparison.pixels_over, over);
    EXPECT_EQ(result.budget.explained(), over);
    EXPECT_EQ(result.budget.unverified(), over);
    EXPECT_EQ(result.status, over == 0 ? Status::agree : Status::differ) << report::message_of(result);
    if (over == 0) continue;
    EXPECT_TRUE(contains(report::message_of(result), std::to_string(over) + " pixels are unverified"))
        << report::message_of(result);
    EXPECT_EQ(result.budget.shapes, (std::vector<std::string>{"one", "two"}));
    EXPECT_TRUE(contains(report::message_of(result),
                         std::to_string(over) + " of " + std::to_string(over) + " pixels over"))
        << report::message_of(result);
    EXPECT_TRUE(contains(report::message_of(result), "'one' 'two'")) << report::message_of(result);
  }
  EXPECT_GT(ties, 50U) << "our picture shows the one or the other";
}

TEST_F(Verify, AGlassBoxOnAFloorAgrees) {
  const VerifyReport report = gates::verify({file("a.sdf", glass_on_floor)}, {}, {});
  EXPECT_EQ(report.exit_code(), 0) << report::message_of(report.scenes[0]);
  EXPECT_EQ(report.scenes[0].budget.unverified(), 0U) << "up to 3 % were, while POV-Ray decided by itself";
}

/// The places of the overlap of the two boxes, a pixel away from its edges.
std::vector<PixelPlace> places_of_overlap(const Image& one, const Image& other) {
  const auto differs = [&](int x, int y) {
    return !comparison::is_within(one.pixel(x, y), other.pixel(x, y), 1e-3);
  };
  std::vector<PixelPlace> places;
  for (int y = 1; y + 1 < one.height; ++y) {
    for (int x = 1; x + 1 < one.width; ++x) {
      if (differs(x, y) && differs(x - 1, y) && differs(x + 1, y) && differs(x, y - 1) && differs(x, y + 1)) {
        places.push_back({x, y});
      }
    }
  }
  return places;
}

/// The budget of a reference against our picture, in which only the given pixels may differ.
attribution::Budget budget_of(const Loaded& loaded, const Image& reference,
                              const std::vector<PixelPlace>& places) {
  Image test = reference;
  const Image ours = loaded.render();
  for (const auto& p : places) std::copy_n(ours.pixel(p.x, p.y), 3, test.pixel(p.x, p.y));
  return attribution::attribute({{loaded.scene, loaded.camera(), test.width, test.height},
                                 reference,
                                 test,
                                 1e-6,
                                 renderers::povray_resolution()});
}

/// How many of the places that are over are explained.
std::size_t explained(const Loaded& loaded, const Image& reference, const std::vector<PixelPlace>& places) {
  return budget_of(loaded, reference, places).explained();
}

TEST_F(Verify, TheOtherOfTwoCoincidentSurfacesIsATieButAThirdColourIsNot) {
  const Loaded loaded(file("a.sdf", coincident("red", "blue")));
  const Image one = loaded.with_nearer(0).render();
  const Image two = loaded.with_nearer(1).render();
  const auto places = places_of_overlap(one, two);
  ASSERT_GT(places.size(), 50U);
  EXPECT_EQ(explained(loaded, one, places) + explained(loaded, two, places), places.size())
      << "our picture shows the one or the other";
  for (const float error : {0.01F, -0.01F, 1e-4F, 1e-5F}) {
    for (Image wrong : {one, two}) {
      for (const auto& place : places) wrong.pixel(place.x, place.y)[1] += error;
      const auto budget = budget_of(loaded, wrong, places);
      EXPECT_EQ(budget.pixels.size(), places.size());
      EXPECT_EQ(budget.explained(), 0U) << error;
      EXPECT_TRUE(budget.shapes.empty()) << error;
    }
  }
}

TEST_F(Verify, WhatIsWrongAwayFromEdgesIsNeverATie) {
  for (const std::string& text :
       {ball, block, ball + "define shape box floor -9 -2 -9 9 -1.5 3 blue\n", coincident("red", "blue")}) {
    const Loaded loaded(file("a.sdf", text));
    const Image right = loaded.render();
    Image wrong = right;
    std::vector<PixelPlace> places;
    for (int y = 2; y < 36; y += 5) {
      for (int x = 2; x < 48; x += 5) places.push_back({x, y});
    }
    for (const auto& place : places) wrong.pixel(place.x, place.y)[2] += 0.01F;
    EXPECT_EQ(explained(loaded, wrong, places), 0U) << text;
  }
}

TEST_F(Verify, ASceneThatIsRenderedWronglyIsNotExcused) {
  // As if a sphere had been a hundredth larger: at its silhouette and in its shading.
  const Loaded loaded(file("a.sdf", ball));
  Loaded wrong = loaded;
  std::get<Sphere>(wrong.scene.shapes[0].geometry).radius *= 1.01;
  const Image reference = wrong.render();
  const auto places = comparison::pixels_over(reference, loaded.render(), 1e-6);
  ASSERT_GT(places.size(), 100U);
  EXPECT_EQ(explained(loaded, reference, places), 0U);
}

TEST_F(Verify, NeitherFarLightsNorScalesMakeAWrongPictureATie) {
  // Each of these once let rounding, magnified, pass for a jump.
  const std::vector<std::string> texts{
      replaced(ball, "light key 3 6 4", "light key 3e7 6e7 4e7"),
      ball + "transform ball scale 1e-3 1e3 1\ntransform ball scale 1e3 1e-3 1\n",
      ball + "define shape composite all ball\ntransform all scale 1000 1000 1000\n",
      block + "transform block scale 1e-4 1e-4 1e-4\ntransform block scale 1e4 1e4 1e4\n",
  };
  for (const std::string& text : texts) {
    const Loaded loaded(file("a.sdf", text));
    Image wrong = loaded.render();
    std::vector<PixelPlace> places;
    for (int y = 2; y < 36; y += 5) {
      for (int x = 2; x < 48; x += 5) places.push_back({x, y});
    }
    for (const auto& place : places) wrong.pixel(place.x, place.y)[0] += 2e-5F;
    EXPECT_EQ(explained(loaded, wrong, places), 0U) << text;
  }
}

TEST_F(Verify, TheSameGlassUnderTwoRootsIsATieOfEachInstance) {
  // Shared children, a hair apart: POV-Ray does not resolve which it crosses, and we do.
  const std::string text = materials + R"(
define material glass 0.1 0.1 0.3 0.2 0.1 0.1 0.2 0.2 0.2 10 mirror 0.1 0.1 0.1 transmit 0.7 0.8 0.8 eta 1.3
define shape sphere big 0 -1 -10 3.5 glass
define shape sphere small 0.5 -0.5 -3 0.6 glass
define shape composite one big small
define shape composite two big small
transform two translate 0 0 1e-9
define shape box floor -9 -2 -20 9 -1.9 3 red
)";
  VerifyOptions options;
  options.render.depth = 5;
  const SceneResult result = gates::verify({file("a.sdf", text)}, options, {}).scenes.front();
  EXPECT_GT(result.comparison.pixels_over, 100U);
  EXPECT_EQ(result.comparison.pixels_over, result.budget.explained());
  EXPECT_GT(result.budget.unverified(), 100U) << "the export does not change where surfaces are";
  EXPECT_EQ(result.status, Status::differ) << report::message_of(result);
}

// Term by term.

const std::string all_terms_scene = materials + R"(
define material glass 0.1 0.1 0.1 0.1 0.1 0.1 0.3 0.3 0.3 20 transmit 0.7 0.7 0.7 eta 1.4
define material silver 0.1 0.1 0.1 0.1 0.1 0.1 0.3 0.3 0.3 20 mirror 0.6 0.6 0.6
define shape sphere bead 1 0.3 -3.5 0.5 glass
define shape sphere ball -0.9 0.3 -4 0.9 silver
define shape sphere pea 0.3 -0.2 -3 0.25 red
define shape box floor -9 -2 -12 9 -1 0 blue
)";

using SceneFault = void (*)(Scene&, RenderOptions&);

/// Renders another scene than it is asked for.
class WrongRenderer : public renderers::Renderer {
 public:
  explicit WrongRenderer(SceneFault fault) : Renderer({"wrong", "wrong"}), fault_(fault) {}

  std::string version() const override { return {}; }
  renderers::Rendered render(const Shot& shot) const override {
    Scene wrong = shot.scene;
    RenderJob job = job_of(shot);
    fault_(wrong, job.options);
    return {textbook::render(wrong, shot.camera, job)};
  }

 private:
  SceneFault fault_;
};

TEST_F(Verify, ADifferenceIsFoundInTheTermInWhichItLives) {
  struct Case {
    const char* term;
    SceneFault fault;
  };
  static const auto weaken = [](Scene& scene, Rgbd Material::*what) {
    for (Material& m : scene.materials) m.*what *= 0.9;
  };
  const std::string scene = file("a.sdf", all_terms_scene);
  for (const Case& c :
       {Case{"ambient", [](Scene&s, RenderOptions&) { weaken(s, &Material::ka); }},
        Case{"diffuse", [](Scene&s, RenderOptions&) { weaken(s, &Material::kd); }},
        Case{"specular", [](Scene&s, RenderOptions&) { weaken(s, &Material::ks); }},
        Case{"shadow", [](Scene&, RenderOptions&o) { o.shadows = false; }},
        Case{"mirror", [](Scene&s, RenderOptions&) { weaken(s, &Material::mirror); }},
        Case{"refraction", [](Scene&s, RenderOptions&) { weaken(s, &Material::transmit); }}}) {
    VerifyOptions options;
    options.terms = true;
    const WrongRenderer ours(c.fault);
    options.ours = &ours;
    const SceneResult result = gates::verify({scene}, options, {}).scenes.front();
    EXPECT_EQ(result.status, Status::differ) << c.term;
    EXPECT_TRUE(contains(report::message_of(result), std::string("lives in the term ") + c.term))
        << c.term << ": " << report::message_of(result);
    EXPECT_EQ(result.budget.explained() + result.budget.count(attribution::Cause::unexplained),
              result.comparison.pixels_over);
  }
}

TEST_F(Verify, EveryTermOfARightSceneAgrees) {
  VerifyOptions options;
  options.terms = true;
  const SceneResult result = gates::verify({file("a.sdf", all_terms_scene)}, options, {}).scenes.front();
  EXPECT_EQ(result.status, Status::agree) << report::message_of(result);
  ASSERT_EQ(result.terms.size(), attribution::all_terms.size());
  for (const gates::TermResult& t : result.terms) {
    EXPECT_EQ(t.unexplained, 0U) << to_string(t.term);
    ASSERT_TRUE(t.in_scene && t.comparison) << to_string(t.term);
    EXPECT_LE(t.comparison->judged_error, 1e-6) << to_string(t.term);
  }
  const SceneResult plain = gates::verify({file("b.sdf", ball)}, options, {}).scenes.front();
  EXPECT_EQ(plain.terms.size(), attribution::all_terms.size());
  EXPECT_EQ(std::count_if(plain.terms.begin(), plain.terms.end(), [](const auto& t) { return t.in_scene; }),
            4)
      << "no mirror, no glass";
}

TEST_F(Verify, NothingOverNeedsNoProof) {
  const Loaded loaded(file("a.sdf", ball));
  const auto budget = budget_of(loaded, loaded.render(), {});
  EXPECT_TRUE(budget.pixels.empty());
  EXPECT_TRUE(budget.shapes.empty());
}

}  // namespace
}  // namespace plumb::tests
