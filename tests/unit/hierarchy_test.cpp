// The graph of composites, without a walk over its instances: the same results as with one.
#include "tracer/scene/hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>

#include "tests/support/random_scene.hpp"
#include "tracer/format/check_hierarchy.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/formulas/quad.hpp"
#include "tracer/formulas/sphere.hpp"
#include "tracer/scene/dielectrics.hpp"

namespace plumb {
namespace {

constexpr unsigned scenes = 300;

/// Composites c0, c1, ... of two of the one before, the second one moved aside; the last one is the world.
std::string doublings(int n, const std::string& step = "translate 3 0 0") {
  std::string text = "define material red 1 0 0 1 0 0 1 1 1 20\ndefine shape sphere ball 0 0 -5 1 red\n";
  std::string below = "ball";
  for (int i = 0; i < n; ++i) {
    const std::string name = "c" + std::to_string(i);
    text += "define shape composite " + name + "m " + below + "\ntransform " + name + "m " + step + "\n";
    text += "define shape composite " + name + " " + below + " " + name + "m\n";
    below = name;
  }
  return text;
}

/// What dielectrics_around promises, said by a walk over all instances.
std::vector<EnclosingDielectric> around_by_a_walk(const Scene& scene, const Ray<double>& ray) {
  std::vector<std::pair<double, EnclosingDielectric>> found;
  std::uint64_t number = 0;
  for_each_instance(scene, [&](const Instance& instance) {
    const std::uint64_t id = number++;
    const Shape& shape = scene.shapes[instance.shape];
    const Material& material = scene.materials[*material_of(shape)];
    if (!material.transmits()) return;
    const Ray<double> local = formulas::transform_ray(instance.world_from_object.inverse, ray);
    std::optional<double> exit;
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      const Vec3d offset = local.origin - sphere->center;
      if (glm::dot(offset, offset) < sphere->radius * sphere->radius)
        exit = formulas::intersect_sphere(local, sphere->center, sphere->radius, false);
    } else {
      const Box& box = std::get<Box>(shape.geometry);
      if (glm::all(glm::lessThan(box.min, local.origin)) && glm::all(glm::lessThan(local.origin, box.max)))
        exit = formulas::intersect_box(local, Corners<double>{box.min, box.max}, no_face)->t;
    }
    if (exit) found.push_back({*exit, {id, material.eta}});
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<EnclosingDielectric> sorted;
  for (const auto& f : found) sorted.push_back(f.second);
  return sorted;
}

TEST(Hierarchy, DielectricsAroundAPointAreThoseOfAWalk) {
  std::size_t found = 0, nested = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    Scene scene = tests::random_scene(seed).scene;
    for (std::size_t i = seed % 2; i < scene.materials.size(); i += 2)
      scene.materials[i].transmit = Rgbd(0.5);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> near(-4, 4);
    for (int i = 0; i < 100; ++i) {
      const Ray<double> ray{{near(random), near(random), near(random) - 6},
                            {near(random), near(random), near(random)}};
      const auto expected = around_by_a_walk(scene, ray);
      const auto actual = dielectrics_around(scene, ray.origin, ray.direction);
      ASSERT_EQ(actual.size(), expected.size()) << seed;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(actual[k].instance, expected[k].instance) << seed;
        EXPECT_EQ(actual[k].eta, expected[k].eta) << seed;
      }
      found += expected.empty() ? 0 : 1;
      nested += expected.size() > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(found, 1000U);  // or nothing was tested
  EXPECT_GT(nested, 20U);
}

/// Of the ray, as outermost first.
template <class Real>
std::vector<std::uint64_t> around(const DielectricsAroundEye<Real>& eye, const Vec3<Real>& direction) {
  std::vector<std::uint64_t> instances;
  for (const EnclosingDielectric& d : eye.of_ray(glm::normalize(direction))) instances.push_back(d.instance);
  return instances;
}

template <class Real>
class DielectricsAroundAnEye : public testing::Test {};
using Reals = testing::Types<float, double, long double, Quad>;
TYPED_TEST_SUITE(DielectricsAroundAnEye, Reals);

TYPED_TEST(DielectricsAroundAnEye, OnGlassAreThoseThatTheRayGoesInto) {
  using V = Vec3<TypeParam>;
  // The eye is on the ball, on the upper face of the block, and in the hall; 0.1 and 0.3 are no binary
  // numbers.
  const Scene scene = read_scene(
                          "define material glass 0 0 0 0 0 0 0 0 0 1 transmit 1 1 1 eta 1.5\n"
                          "define shape box hall -9 -9 -9 9 9 9 glass\n"
                          "define shape sphere ball 0.125 0.5 -0.25 0.375 glass\n"
                          "define shape box block -1 -1 -1 1 0.125 1 glass\n"
                          "define shape box aside 2 0.125 -1 3 2 1 glass\n")
                          .scene;
  const V eye(Vec3d(0.125, 0.125, -0.25));
  const DielectricsAroundEye<TypeParam> on(scene, eye, V(0, 0, -1));
  ASSERT_TRUE(on.is_on_surface());
  using Instances = std::vector<std::uint64_t>;
  EXPECT_EQ(around(on, V(0, 1, 0)), (Instances{0, 1}));
  EXPECT_EQ(around(on, V(TypeParam(0.3), TypeParam(0.1), TypeParam(0.2))), (Instances{0, 1}));
  EXPECT_EQ(around(on, V(0, -1, 0)), (Instances{0, 2}));
  EXPECT_EQ(around(on, V(TypeParam(0.3), TypeParam(-0.1), TypeParam(0.2))), (Instances{0, 2}));

  const DielectricsAroundEye<TypeParam> beside(scene, eye + V(0, TypeParam(0.01), 0), V(0, 0, -1));
  EXPECT_FALSE(beside.is_on_surface());
  EXPECT_EQ(around(beside, V(0, -1, 0)), (Instances{0, 1}));
}

TEST(Hierarchy, DielectricsOfABillionInstancesAreFoundByTheirNumbers) {
  std::string text = doublings(30, "translate 3 0 0");
  text.replace(text.find(" 20\n"), 3, " 20 transmit 1 1 1");
  // Instance n stands at 3 times the number of ones in n: n = 2^30 - 1 is the only one at 90.
  const Scene scene = read_scene(text).scene;
  EXPECT_TRUE(dielectrics_around(scene, {93, 0, -5}, {0, 0, -1}).empty());
  const auto last = dielectrics_around(scene, {90, 0, -5}, {0, 0, -1});
  ASSERT_EQ(last.size(), 1U);
  EXPECT_EQ(last[0].instance, (std::uint64_t{1} << 30) - 1);
}

TEST(Hierarchy, ShapesOfInstancesAreThoseOfAWalk) {
  for (unsigned seed = 0; seed < scenes; ++seed) {
    const Scene scene = tests::random_scene(seed).scene;
    const InstanceShapes shapes(scene);
    std::uint64_t number = 0;
    for_each_instance(scene, [&](const Instance& i) { EXPECT_EQ(shapes.at(number++), i.shape) << seed; });
    EXPECT_THROW(shapes.at(number), std::out_of_range);
  }
}

/// The random scene with factors of a size that may overflow along some of its paths.
Scene with_huge_factors(unsigned seed) {
  Scene scene = tests::random_scene(seed).scene;
  std::mt19937 random(seed);
  const auto one_of = [&](int n) { return std::uniform_int_distribution(0, n - 1)(random); };
  for (Shape& shape : scene.shapes) {
    for (int n = one_of(4); n > 0; --n) {
      Vec3d factors(1);
      for (int axis = 0; axis < 3; ++axis) {
        if (one_of(3) > 0) factors[axis] = one_of(2) == 0 ? 1e100 : 1e-100;
      }
      shape.transform.emplace_back(Scale{factors});
    }
    if (one_of(3) == 0) shape.transform.emplace_back(Translate{Vec3d(0, 0, 1e90)});
  }
  return scene;
}

TEST(Hierarchy, WhatOverflowsIsWhatAWalkFinds) {
  std::size_t overflowing = 0, finite = 0;
  for (unsigned seed = 0; seed < scenes; ++seed) {
    const Scene scene = with_huge_factors(seed);
    std::vector<ShapeId> exact = shapes_that_overflow(scene);
    std::vector<ShapeId> reported;
    for (const HierarchyError& error : check_hierarchy(scene)) reported.push_back(error.shape);
    EXPECT_EQ(reported, exact) << seed;
    std::sort(exact.begin(), exact.end());
    const auto bound = shapes_that_may_overflow(scene);
    EXPECT_TRUE(std::includes(bound.begin(), bound.end(), exact.begin(), exact.end())) << seed;
    overflowing += exact.empty() ? 0 : 1;
    finite += bound.empty() ? 1 : 0;
  }
  EXPECT_GT(overflowing, 20U);  // or nothing was tested
  EXPECT_GT(finite, 20U);
}

TEST(Hierarchy, WhatOnlyTheBoundDoubtsIsRead) {
  std::string text = doublings(1, "scale 1 1e99 1") + "transform c0m scale 1 1e99 1\n";
  for (int i = 0; i < 2; ++i) text += "transform ball scale 1e99 1 1\n";
  const ReadResult result = read_scene(text);
  EXPECT_EQ(shapes_that_may_overflow(result.scene), std::vector<ShapeId>{0});
  EXPECT_FALSE(result.has_errors());
}

TEST(Hierarchy, SaneScenesAreNotWalked) {
  for (unsigned seed = 0; seed < scenes; ++seed)
    EXPECT_TRUE(shapes_that_may_overflow(tests::random_scene(seed).scene).empty()) << seed;
  EXPECT_TRUE(shapes_that_may_overflow(read_scene(doublings(300)).scene).empty());
  EXPECT_TRUE(shapes_that_may_overflow(read_scene(doublings(300, "rotate 30 1 2 3")).scene).empty());
}

TEST(Hierarchy, ABillionInstancesAreRead) {
  const ReadResult result = read_scene(doublings(30));
  EXPECT_FALSE(result.has_errors());
  EXPECT_EQ(count_instances(result.scene)[result.scene.shapes.size() - 1], std::uint64_t{1} << 30);
}

TEST(Hierarchy, ABillionInstancesThatMayOverflowAreRefused) {
  const ReadResult result = read_scene(doublings(29, "scale 1e20"));
  ASSERT_TRUE(result.has_errors());
  const auto error = std::find_if(result.findings.begin(), result.findings.end(),
                                  [](const Finding& f) { return f.severity == Severity::error; });
  EXPECT_EQ(error->line, 2);
  EXPECT_NE(error->message.find("'ball' that may overflow"), std::string::npos) << error->message;
}

TEST(Hierarchy, ABillionInstancesAreNotWalked) {
  const Scene scene = read_scene(doublings(30)).scene;
  try {
    for_each_instance(scene, [](const Instance&) { FAIL() << "the walk began"; });
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 2000000"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace plumb
