// A light on a surface is warned of when a scene is read; one beside it is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/end_to_end.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/scene/lights_on_surfaces.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::tests {
namespace {

const std::string head =
    "define material m 0 0 0 1 1 1 0 0 0 1\ndefine camera eye 60\nrender eye x.ppm 8 8\n";
const std::string ball = head + "define shape sphere lamp 0 130 -250 40 m\n";
const std::string block = head + "define shape box lamp -1 -2 -5 3 1 -4 m\n";

std::string light_at(const Vec3d& p) {
  return "define light sun " + to_text(p.x) + " " + to_text(p.y) + " " + to_text(p.z) + " 1 1 1 1\n";
}

bool warns(const std::string& scene) {
  const ReadResult read = read_scene(scene);
  EXPECT_FALSE(read.has_errors()) << scene;
  return std::any_of(read.findings.begin(), read.findings.end(), [](const Finding& f) {
    return f.severity == Severity::warning &&
           contains(f.message, "light 'sun' lies exactly on the surface of 'lamp'");
  });
}

TEST(LightsOnSurfaces, OnASphere) {
  EXPECT_TRUE(warns(ball + light_at({0, 90, -250})));
  EXPECT_TRUE(warns(ball + light_at({24, 98, -250})));
  for (const double off : {1e-9, 1.0, 40.0}) {
    EXPECT_FALSE(warns(ball + light_at({0, 90 + off, -250}))) << off;
    EXPECT_FALSE(warns(ball + light_at({0, 90 - off, -250}))) << off;
  }
}

TEST(LightsOnSurfaces, OnFacesEdgesAndCornersOfABox) {
  for (const Vec3d& place :
       {Vec3d(0, 1, -4.5), Vec3d(-1, 0, -4.5), Vec3d(0, 0, -5), Vec3d(3, 1, -4.5), Vec3d(3, -2, -4)})
    EXPECT_TRUE(warns(block + light_at(place))) << place.x << " " << place.y << " " << place.z;
  for (const Vec3d& place : {Vec3d(0, 0, -4.5), Vec3d(0, 1.000001, -4.5), Vec3d(0, 0.999999, -4.5),
                             Vec3d(4, 1, -4.5), Vec3d(3, 1, -3)})
    EXPECT_FALSE(warns(block + light_at(place))) << place.x << " " << place.y << " " << place.z;
}

TEST(LightsOnSurfaces, WhereTransformsAndCompositesPutIt) {
  const std::string moved = block +
                            "define shape composite group lamp\ntransform lamp rotate 30 0 0 1\n"
                            "transform group scale 2 2 2\ntransform group translate 1 0 0\n";
  const double c = std::sqrt(3.0) / 2, s = 0.5;
  const Vec3d in_box(0.5, 1, -4.5);  // on its top
  const Vec3d place(2 * (c * in_box.x - s * in_box.y) + 1, 2 * (s * in_box.x + c * in_box.y), 2 * in_box.z);
  EXPECT_TRUE(warns(moved + light_at(place)));
  EXPECT_FALSE(warns(moved + light_at(place + Vec3d(0, 1e-6, 0))));
  EXPECT_FALSE(warns(moved + light_at(in_box))) << "the box is not there any more";
}

TEST(LightsOnSurfaces, ALightThatDoesNotShineIsNoneAndManyInstancesAreLeftAlone) {
  EXPECT_FALSE(warns(ball + "define light sun 0 90 -250 1 1 1 0\n"));
  Scene scene = read_scene(ball + light_at({0, 90, -250})).scene;
  ASSERT_EQ(lights_on_surfaces(scene).size(), 1U);
  for (int level = 0; level < 21; ++level) {
    const ShapeId below = scene.shapes.size() - 1;
    scene.shapes.push_back({"c" + std::to_string(level), Composite{{below, below}}, {}});
  }
  EXPECT_TRUE(lights_on_surfaces(scene).empty()) << "two million paths";
}

}  // namespace
}  // namespace plumb::tests
