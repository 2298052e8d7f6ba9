// What the methods reach, judged by 113 bits. PLUMB_STABILITY_RAYS rays each; the figures of the project are
// those of 10,000,000.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "references/report/atlas.hpp"
#include "references/studies/stability/boxes.hpp"
#include "references/studies/stability/catalogue.hpp"
#include "references/studies/stability/spheres.hpp"
#include "tracer/formulas/phong.hpp"
#include "tracer/methods/method_sets.hpp"
#include "tracer/methods/sphere.hpp"

namespace plumb::tests {
namespace {

long rays() {
  const char* const asked = std::getenv("PLUMB_STABILITY_RAYS");
  return asked == nullptr ? 20'000 : std::atol(asked);
}

/// Every ray that truly hits, the grazing ones too.
studies::stability::SphereSetting any_hit(double distance, studies::stability::Random& random) {
  return {Vec3<double>(0), 1, distance, std::sqrt(studies::stability::uniform(random))};
}

/// Share of the true hits of a unit sphere that a method loses.
template <class Real>
double lost(studies::stability::IntersectSphere<Real> method, studies::stability::SphereAt setting,
            double distance) {
  const studies::stability::Experiment experiment = studies::stability::sphere_trial<Real>(method, setting);
  studies::stability::Random random(1);
  long hits = 0, missed = 0;
  for (long i = 0; i < rays(); ++i) {
    const studies::stability::Trial trial = experiment(distance, random);
    hits += trial.counts ? 1 : 0;
    missed += trial.counts && trial.missed ? 1 : 0;
  }
  return static_cast<double>(missed) / static_cast<double>(hits);
}

TEST(Stability, TheNaiveSphereLosesHitsInFloat) {
  const double near = lost<float>(&methods::sphere_naive<float>, &any_hit, 1000);
  const double far = lost<float>(&methods::sphere_naive<float>, &any_hit, 4100);
  std::printf("lost by b^2 - 4ac in float: %.2f %% at d/r 1000, %.2f %% at 4100\n", 100 * near, 100 * far);
  EXPECT_GT(near, 0.01);
  EXPECT_GT(far, 0.05);
}

TEST(Stability, HainesLosesNoClearHitInFloatUpToHalfAMillion) {
  for (const double distance : {1e3, 4100.0, 1e5, 5e5})
    EXPECT_EQ(lost<float>(&methods::sphere_haines<float>, &studies::stability::far_sphere, distance), 0)
        << distance;
}

double most_ulps(studies::stability::SphereAt setting) {
  const studies::stability::Experiment experiment =
      studies::stability::sphere_trial<double>(&formulas::intersect_sphere<double>, setting);
  studies::stability::Random random(2);
  double most = 0;
  for (long i = 0; i < rays(); ++i) {
    const double value = std::pow(10.0, 6 * studies::stability::uniform(random));
    const studies::stability::Trial t = experiment(value, random);
    if (t.counts) most = std::max(most, t.missed ? 1e300 : t.ulps);
  }
  return most;
}

TEST(Stability, ClearHitsOfTheDefaultAreWithin16UlpInDoubleUpToAMillion) {
  EXPECT_LE(most_ulps(&studies::stability::far_sphere), 16);
  EXPECT_LE(most_ulps(&studies::stability::small_sphere), 16);
  EXPECT_LE(most_ulps(&studies::stability::scaled_sphere), 16);
  EXPECT_LE(most_ulps(&studies::stability::shrunk_sphere), 16);
  EXPECT_LE(most_ulps(&studies::stability::offset_sphere), 16);
}

long self_hits(const studies::stability::Start<double>& way) {
  const studies::stability::Experiment experiment =
      studies::stability::start_trial<double>(way, &studies::stability::scaled_sphere);
  studies::stability::Random random(3);
  long found = 0;
  for (long i = 0; i < rays(); ++i) {
    const double scale = std::pow(10.0, 16 * studies::stability::uniform(random) - 8);
    found += experiment(scale, random).self_shadow ? 1 : 0;
  }
  return found;
}

TEST(Stability, NoRayMeetsTheSurfaceItLeaves) {
  EXPECT_EQ(self_hits({&formulas::secondary_origin<double>, &formulas::is_ahead<double>, true}), 0);
  EXPECT_GT(self_hits({&formulas::secondary_origin<double>, [](double t, double) { return t > 0; }, false}),
            rays() / 20)
      << "the test cannot fail";
}

/// Boxes about the origin that share faces, edges and a corner there; aimed at what they share.
long slips_through(bool at_corner) {
  studies::stability::Random random(4);
  long slipped = 0;
  for (long i = 0; i < rays(); ++i) {
    const Vec3<double> eye = 4.0 * studies::stability::unit_vector(random);
    const Vec3<double> aim(0, 0, at_corner ? 0 : 1.8 * studies::stability::uniform(random) - 0.9);
    const Ray<double> ray{eye, glm::normalize(aim - eye)};
    bool hit = false;
    for (int octant = 0; octant < 8; ++octant) {
      const Vec3<double> low((octant & 1) - 1, ((octant >> 1) & 1) - 1, ((octant >> 2) & 1) - 1);
      hit |= formulas::intersect_box(ray, {low, low + 1.0}, no_face).has_value();
    }
    slipped += hit ? 0 : 1;
  }
  return slipped;
}

TEST(Stability, NothingSlipsBetweenBoxesThatShareFaces) {
  EXPECT_EQ(slips_through(false), 0);
  EXPECT_EQ(slips_through(true), 0);
}

/// Any exponent, zeros of both signs and infinity among them.
double wild(studies::stability::Random& random) {
  const double kind = studies::stability::uniform(random);
  if (kind < 0.1) return studies::stability::uniform(random) < 0.5 ? 0.0 : -0.0;
  if (kind < 0.12) return std::numeric_limits<double>::infinity();
  return (studies::stability::uniform(random) < 0.5 ? -1 : 1) *
         std::pow(10.0, 600 * studies::stability::uniform(random) - 300);
}

TEST(Stability, NoNanLeavesAnIntersection) {
  studies::stability::Random random(5);
  const auto vector = [&] { return Vec3<double>(wild(random), wild(random), wild(random)); };
  for (long i = 0; i < rays(); ++i) {
    const Ray<double> ray{vector(), vector()};
    const auto sphere = formulas::intersect_sphere(ray, vector(), std::abs(wild(random)), i % 2 == 0);
    ASSERT_FALSE(sphere && std::isnan(*sphere));
    const Vec3<double> a = vector(), b = vector();
    const auto box =
        formulas::intersect_box(ray, {glm::min(a, b), glm::max(a, b)}, static_cast<Face>(i % 7) - 1);
    ASSERT_FALSE(box && std::isnan(box->t));
  }
}

TEST(Stability, TheSameSweepGivesTheSameNumbers) {
  const studies::stability::Sweep sweep{true, "box-edge", {}, ""};
  EXPECT_EQ(report::to_json(studies::stability::stability(sweep)),
            report::to_json(studies::stability::stability(sweep)));
}

TEST(Stability, AnUnknownConditionIsNamed) {
  EXPECT_THROW(studies::stability::stability({true, "weather", {}, ""}), std::invalid_argument);
}

TEST(Methods, EverySetRendersAndTheFirstIsTheLecture) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].kd = Rgbd(1);
  scene.shapes.push_back({"ball", Sphere{{0, 0, -5}, 1, 0}, {}});
  scene.lights.push_back({"lamp", {3, 3, 0}, Rgbd(1), 1});
  textbook::RenderJob job;
  job.width = job.height = 8;
  const Camera camera;
  ASSERT_EQ(methods::method_sets().front().id, "lecture");
  EXPECT_EQ(methods::render_with_methods(methods::method_sets().front(), scene, camera, job).rgb,
            textbook::render(scene, camera, job).rgb);
  for (const methods::MethodSet& set : methods::method_sets())
    EXPECT_EQ(methods::render_with_methods(set, scene, camera, job).width, 8) << set.id;
}

}  // namespace
}  // namespace plumb::tests
