// Shots and what renders them: which picture is asked for, what the cache keeps of any program, and by what
// name a reference is found.
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "references/attribution/attribution.hpp"
#include "references/renderers/cached.hpp"
#include "references/renderers/ours.hpp"
#include "references/renderers/povray.hpp"
#include "references/renderers/registry.hpp"
#include "tests/support/end_to_end.hpp"
#include "tests/support/run.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

using renderers::CachedRenderer;
using renderers::ExportedShot;
using renderers::Holds;
using renderers::Rendered;

Scene two_cameras() {
  return read_scene(R"(
define material red 0.9 0.1 0.1 0.5 0.5 0.5 0 0 0 1
ambient 0.5 0.5 0.5
define shape box front -1 -1 -6 1.5 1 -4 red
define camera eye 90
define camera other 30
render other image.ppm 12 8
)")
      .scene;
}

TEST(Shot, IsThatOfTheRenderLine) {
  const Scene scene = two_cameras();
  const Shot shot = shot_of(scene, {}, "a.sdf");
  EXPECT_EQ(shot.camera.name, "other");
  EXPECT_EQ(shot.width, 12);
  EXPECT_EQ(shot.height, 8);
  EXPECT_EQ(shot.options, RenderOptions{});
  EXPECT_EQ(shot.file, "a.sdf");
}

TEST(Shot, IsThatOfTheOptionsWhereTheySayOtherwise) {
  const Scene scene = two_cameras();
  RenderOptions options;
  options.depth = 3;
  const Shot shot = shot_of(scene, {Size{5, 7}, "eye", options});
  EXPECT_EQ(shot.camera.name, "eye");
  EXPECT_EQ(job_of(shot).width, 5);
  EXPECT_EQ(job_of(shot).height, 7);
  EXPECT_EQ(job_of(shot).options.depth, 3);
  EXPECT_THROW(shot_of(scene, {{}, "third"}), std::invalid_argument);
}

/// A program that counts how often it renders.
class CountedProgram : public renderers::ProgramRenderer {
 public:
  CountedProgram(const std::string& name, int& runs, Holds made = Holds::float32)
      : ProgramRenderer({name, name}), runs_(runs), made_(made) {}

  std::string program() const override { return "/bin/true"; }
  std::string version() const override { return "1"; }
  ExportedShot exported(const Shot& shot) const override {
    return {facts().name, {}, shot.camera.name, shot.width, shot.height};
  }
  Rendered render(const Shot& shot) const override {
    ++runs_;
    Rendered picture{Image(shot.width, shot.height)};
    picture.holds = made_;
    picture.cpu_seconds = 1;
    return picture;
  }

 private:
  int& runs_;
  Holds made_;
};

class CachedPrograms : public testing::Test {
 protected:
  CachedPrograms() { setenv("PLUMB_CACHE", workplace_.path("cache").c_str(), 1); }
  ~CachedPrograms() override { unsetenv("PLUMB_CACHE"); }

  Rendered rendered(const std::string& name, const std::string& camera = "", Holds made = Holds::float32) {
    const CachedRenderer renderer(std::make_unique<CountedProgram>(name, runs_, made));
    return renderer.render(shot_of(scene_, {{}, camera}));
  }
  int runs_ = 0;

 private:
  Scene scene_ = two_cameras();
  Workplace workplace_;
};

TEST_F(CachedPrograms, RenderOnce) {
  EXPECT_FALSE(rendered("one").cached);
  const Rendered again = rendered("one");
  EXPECT_TRUE(again.cached);
  EXPECT_EQ(again.cpu_seconds, 0);
  EXPECT_EQ(runs_, 1);
}

TEST_F(CachedPrograms, RenderAgainWhatIsAskedOtherwiseOrOfAnother) {
  rendered("one");
  EXPECT_FALSE(rendered("two").cached);
  EXPECT_FALSE(rendered("one", "eye").cached);
  EXPECT_EQ(runs_, 3);
}

TEST_F(CachedPrograms, RenderAgainWhatHeldLessThanItCould) {
  rendered("one", "", Holds::bits16);
  EXPECT_FALSE(rendered("one").cached);
  EXPECT_EQ(runs_, 2);
}

TEST(Registry, NamesTheReferencesItHas) {
  EXPECT_EQ(renderers::program_renderer({})->facts().name, "povray");
  EXPECT_EQ(renderers::program_renderer({.name = "povray"})->facts().title, "POV-Ray");
  try {
    renderers::program_renderer({.name = "nosuch"});
    FAIL() << "there is none of that name";
  } catch (const std::invalid_argument& error) {
    const std::string said = error.what();
    EXPECT_TRUE(contains(said, "nosuch") && contains(said, "povray")) << said;
  }
}

/// A renderer that resolves less than POV-Ray is excused for more, and only that one is.
TEST(Resolution, IsThatOfTheRenderer) {
  Scene scene = two_cameras();
  Scene moved = scene;
  const Shot shot = shot_of(scene, {Size{8, 8}, "eye"});
  const double extent = renderers::povray_resolution().extent(scene, shot.camera);
  // A face on each side of what the centres of a column see: 50 steps of POV-Ray away from it.
  std::get<Box>(scene.shapes[0].geometry).max.x += 0.5e-6 * extent;
  std::get<Box>(moved.shapes[0].geometry).max.x -= 0.5e-6 * extent;
  const renderers::OurRenderer ours(renderers::OwnTracer::textbook);
  const Image test = ours.render(shot).image;
  const Image reference = ours.render({moved, shot.camera, 8, 8}).image;
  renderers::Resolution coarse = renderers::povray_resolution();
  coarse.step = 1e-5;
  const auto explained = [&](const renderers::Resolution& resolution) {
    return attribution::attribute({shot, reference, test, 1e-6, resolution}).explained();
  };
  EXPECT_EQ(explained(renderers::povray_resolution()), 0U);
  EXPECT_GT(explained(coarse), 0U);
}

}  // namespace
}  // namespace plumb::tests
