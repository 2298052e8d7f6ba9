// What a scene needs: scenes whose answers are known, and figures that are measured again by other means.
#include "references/studies/needs/needs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/support/run.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

using studies::Observed;
using studies::Untouched;
using textbook::RayKind;

Scene course_scene(const std::string& name) {
  return load_scene(source_path("tests/scenes/" + name + ".sdf"), {});
}

Scene scene_of(const std::string& text) { return read_scene(text).scene; }

const Camera& camera_of(const Scene& scene) { return scene.camera(scene.renders.front().camera); }

RenderJob job_of(int width = 40, int height = 30) {
  RenderJob job;
  job.width = width;
  job.height = height;
  return job;
}

Observed observed(const Scene& scene, const RenderJob& job = job_of()) {
  return studies::observe(scene, camera_of(scene), job);
}

// ---- what is observed

TEST(Observe, CountsTheRaysThatTheEngineCounts) {
  for (const char* name :
       {"combined-object-diagram", "shadow", "mirror", "total-reflection", "nested-glass"}) {
    const Scene scene = course_scene(name);
    const Observed seen = observed(scene);
    engine::Statistics counted;
    engine::render(scene, camera_of(scene), job_of(), &counted);
    EXPECT_EQ(seen.of(RayKind::camera), counted.camera_rays) << name;
    EXPECT_EQ(seen.shadow_rays, counted.shadow_rays) << name;
    EXPECT_TRUE(seen.is_whole());
  }
}

TEST(Observe, WhatLiesBehindTheEyeTouchesNoRay) {
  const Scene scene = course_scene("ray-behind-the-eye");
  const Untouched untouched = studies::untouched_by(scene, observed(scene), {});
  ASSERT_EQ(untouched.shapes.size(), 2U);
  EXPECT_EQ(scene.shapes[untouched.shapes[0]].name, "behind");
  EXPECT_EQ(scene.shapes[untouched.shapes[1]].name, "also_behind");
  ASSERT_EQ(untouched.materials.size(), 1U);
  EXPECT_EQ(scene.materials[untouched.materials[0]].name, "red");
  EXPECT_TRUE(untouched.lights.empty());
}

TEST(Observe, ABlockerThatIsNotSeenIsTouched) {
  const Scene scene = scene_of(
      "define material m 0 0 0 1 1 1 0 0 0 1\ndefine material hidden 0 0 0 1 0 0 0 0 0 1\n"
      "define shape box floor -5 -2 -9 5 -1 -2 m\ndefine shape sphere above 0 6 -5 1 hidden\n"
      "define light lamp 0 20 -5 1 1 1 1\ndefine light below 0 -20 -5 1 1 1 1\ndefine camera eye 60\n");
  const Observed seen = observed(scene);
  EXPECT_EQ(seen.shapes[1].hits(), 0U);
  EXPECT_GT(seen.shapes[1].blocked, 0U);
  EXPECT_EQ(seen.shapes[1].blocked, seen.shadows);
  const Untouched untouched = studies::untouched_by(scene, seen, {});
  EXPECT_TRUE(untouched.shapes.empty());
  EXPECT_EQ(untouched.materials, std::vector<MaterialId>{1});
  EXPECT_EQ(untouched.lights, std::vector<std::size_t>{1});
}

/// A shadow ray goes through it unnoticed, but not unchanged.
TEST(Observe, GlassThatFiltersLightOutsideThePictureIsNeeded) {
  const Scene scene = scene_of(
      "define material m 0 0 0 1 1 1 0 0 0 1\n"
      "define material glass 0 0 0 0 0 0 0 0 0 1 transmit 1 0.5 0.5 eta 1.5\n"
      "define shape box floor -5 -2 -9 5 -1 -2 m\ndefine shape sphere above 0 6 -5 1 glass\n"
      "define light lamp 0 20 -5 1 1 1 1\ndefine camera eye 60\n");
  const auto not_needed = [&](GlassShadow shadow) {
    RenderJob job = job_of();
    job.options.glass_shadow = shadow;
    return studies::untouched_by(scene, observed(scene, job), job.options).shapes;
  };
  EXPECT_TRUE(not_needed(GlassShadow::full).empty());
  EXPECT_TRUE(not_needed(GlassShadow::filtered).empty());
  EXPECT_EQ(not_needed(GlassShadow::none), std::vector<ShapeId>{1});
}

TEST(Observe, SeesTheRaysOfEachKind) {
  const Observed total = observed(course_scene("total-reflection"));
  EXPECT_GT(total.of(RayKind::totally_reflected), 0U);
  EXPECT_GT(total.of(RayKind::refracted), 0U);
  EXPECT_EQ(total.of(RayKind::mirrored), 0U);
  EXPECT_EQ(total.nested, 0U);
  EXPECT_GT(observed(course_scene("nested-glass")).nested, 0U);
  const Observed mirror = observed(course_scene("mirror"));
  EXPECT_GT(mirror.of(RayKind::mirrored), 0U);
  EXPECT_EQ(mirror.of(RayKind::refracted), 0U);
  const Observed shadow = observed(course_scene("shadow"));
  EXPECT_GT(shadow.shadows, 0U);
  EXPECT_LT(shadow.shadows, shadow.shadow_rays);
  EXPECT_EQ(shadow.deepest, 0);
}

TEST(Observe, MirrorsThatFaceEachOtherReachTheDepthAskedFor) {
  const Scene scene = course_scene("recursion-depth");
  for (const int depth : {3, 8}) {
    RenderJob job = job_of();
    job.options.depth = depth;
    const Observed seen = observed(scene, job);
    EXPECT_EQ(seen.deepest, depth - 1);
    EXPECT_GT(seen.black_at_limit, 0U);
  }
}

TEST(Features, TellWhatIsInTheSceneFromWhatIsSeen) {
  const Scene scene = course_scene("ray-behind-the-eye");
  const auto features = studies::features_of(scene, camera_of(scene), {}, observed(scene));
  const auto row = [&](const std::string& id) {
    return *std::find_if(features.begin(), features.end(), [&](const auto& f) { return f.id == id; });
  };
  EXPECT_EQ(row("box").in_scene, 1U);
  EXPECT_EQ(row("box").seen, 0U);
  EXPECT_EQ(row("sphere").in_scene, 2U);
  EXPECT_GT(row("sphere").seen, 0U);
  EXPECT_EQ(row("mirror").in_scene, 0U);
}

TEST(Untouched, WithoutItEveryPictureIsTheSame) {
  std::size_t taken_out = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_path("tests/scenes"))) {
    if (entry.path().extension() != ".sdf") continue;
    const Scene scene = load_scene(entry.path().string(), {});
    const Untouched untouched = studies::untouched_by(scene, observed(scene, job_of(24, 18)), {});
    taken_out += untouched.shapes.size() + untouched.lights.size();
    const Scene rest = studies::without(scene, untouched);
    EXPECT_EQ(engine::render(scene, camera_of(scene), job_of(24, 18)).rgb,
              engine::render(rest, camera_of(scene), job_of(24, 18)).rgb)
        << entry.path();
  }
  EXPECT_GT(taken_out, 3U);
}

TEST(Untouched, ACompositeGoesWithAllThatItHolds) {
  const Scene scene = scene_of(
      "define material m 1 1 1 0 0 0 0 0 0 1\nambient 1 1 1\ndefine shape sphere far 0 0 50 1 m\n"
      "define shape composite behind far\ndefine shape sphere seen 0 0 -5 1 m\n"
      "define shape composite group seen behind\ndefine camera eye 60\n");
  const Scene rest = studies::without(scene, studies::untouched_by(scene, observed(scene), {}));
  ASSERT_EQ(rest.shapes.size(), 2U);
  EXPECT_EQ(rest.shapes[0].name, "seen");
  EXPECT_EQ(std::get<Composite>(rest.shapes[1].geometry).children, std::vector<ShapeId>{0});
}

// ---- all together

TEST(Needs, TheDepthOfASceneOfMirrorsIsTheAskedOneAndOfOthersOne) {
  const Scene mirrors = course_scene("recursion-depth"), plain = course_scene("phong");
  const auto deep = studies::needs_of(mirrors, camera_of(mirrors), job_of(), 1e-6);
  EXPECT_EQ(deep.depth.same_from, 8);
  EXPECT_GT(deep.depth.change_beyond, 0);
  const auto flat = studies::needs_of(plain, camera_of(plain), job_of(), 1e-6);
  EXPECT_EQ(flat.depth.same_from, 1);
  EXPECT_EQ(flat.depth.change_beyond, 0);
  EXPECT_TRUE(flat.is_same_without_untouched);
}

TEST(Needs, TotalReflectionEndsBeforeTheDepthAskedFor) {
  const Scene scene = course_scene("total-reflection");
  const auto needs = studies::needs_of(scene, camera_of(scene), job_of(), 1e-6);
  EXPECT_EQ(needs.depth.same_from, needs.observed.deepest + 1);
  RenderJob job = job_of();
  job.options.depth = needs.depth.same_from;
  const Image there = engine::render(scene, camera_of(scene), job);
  --job.options.depth;
  const Image before = engine::render(scene, camera_of(scene), job);
  const Image asked = engine::render(scene, camera_of(scene), job_of());
  EXPECT_EQ(there.rgb, asked.rgb);
  EXPECT_NE(before.rgb, asked.rgb);
}

TEST(Needs, CostsAreOfWhatTheSceneHas) {
  const Scene scene = course_scene("mirror");
  const auto needs = studies::needs_of(scene, camera_of(scene), job_of(), 1e-6);
  std::set<std::string> costs;
  for (const auto& cost : needs.costs.costs) {
    costs.insert(cost.feature);
    EXPECT_LE(cost.least, cost.ratio);
    EXPECT_LE(cost.ratio, cost.greatest);
  }
  EXPECT_TRUE(costs.contains("mirrors"));
  EXPECT_FALSE(costs.contains("refraction"));
  EXPECT_EQ(needs.costs.rounds % 2, 1);
}

}  // namespace
}  // namespace plumb::tests
