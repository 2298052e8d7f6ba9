// Slides "Strahl" and "Kugel".
#include "tracer/formulas/ray.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/reals.hpp"
#include "tracer/formulas/sphere.hpp"

namespace plumb {
namespace {

using Exact = long double;

template <class Real>
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Real real(double low, double high) {
    return static_cast<Real>(std::uniform_real_distribution<double>(low, high)(engine_));
  }
  Vec3<Real> vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  /// Not normalised; never near 0.
  Vec3<Real> direction() {
    for (;;) {
      const Vec3<Real> v = vector(1);
      if (glm::dot(v, v) > Real(0.05)) return v * real(0.2, 5);
    }
  }
  /// Passes within some two units of the target.
  Ray<Real> ray_near(const Vec3<Real>& target) {
    const Vec3<Real> origin = vector(10);
    return {origin, (target + vector(2) - origin) * real(0.2, 5)};
  }

 private:
  std::mt19937 engine_;
};

/// The implicit equation |p - m|^2 - r^2 at p(t), and the sum of the sizes of its terms, in long double.
struct Implicit {
  Exact value;
  Exact size;
};

template <class Real>
Implicit implicit_at(const Ray<Real>& ray, const Vec3<Real>& center, Real radius, Exact t) {
  const Vec3<Exact> offset = Vec3<Exact>(ray.origin) - Vec3<Exact>(center);
  const Vec3<Exact> p = offset + t * Vec3<Exact>(ray.direction);
  const Exact r = radius;
  const Exact reach = glm::length(offset) + std::abs(t) * glm::length(Vec3<Exact>(ray.direction));
  return {glm::dot(p, p) - r * r, reach * reach + r * r};
}

/// A stable root solves a quadratic whose coefficients are off by their roundings: offset 1, each dot product
/// 3, the square and the two products of the discriminant 3, root, sum and quotient 3, together with the 3 of
/// the second dot product 13 of half an epsilon; the check in long double adds as many.
template <class Real>
constexpr Exact root_tolerance = 13 * static_cast<Exact>(std::numeric_limits<Real>::epsilon());

/// Squared distance of the half-line from the centre: independent of roots.
template <class Real>
Exact nearest_approach_squared(const Ray<Real>& ray, const Vec3<Real>& center) {
  const Vec3<Exact> d(ray.direction);
  const Vec3<Exact> offset = Vec3<Exact>(ray.origin) - Vec3<Exact>(center);
  const Exact t = std::max(Exact(0), -glm::dot(offset, d) / glm::dot(d, d));
  return glm::dot(offset + t * d, offset + t * d);
}

template <class Real>
class RayFormula : public testing::Test {};
TYPED_TEST_SUITE(RayFormula, tests::Reals);

TYPED_TEST(RayFormula, TheOriginIsAtTZero) {
  using Real = TypeParam;
  const Ray<Real> ray{{1, -2, 3}, {4, 5, 6}};
  EXPECT_EQ(formulas::point_at(ray, Real(0)), Vec3<Real>(1, -2, 3));
}

TYPED_TEST(RayFormula, APointIsTheOriginPlusTDirections) {
  using Real = TypeParam;
  const Ray<Real> ray{{1, -2, 3}, {4, 5, 6}};
  // 1 + 2 * 4, -2 + 2 * 5, 3 + 2 * 6: exact in every type.
  EXPECT_EQ(formulas::point_at(ray, Real(2)), Vec3<Real>(9, 8, 15));
}

TYPED_TEST(RayFormula, WhatARayTellsApartIsEpsilonToThreeQuarters) {
  const double exponent = std::log2(static_cast<double>(formulas::resolution<TypeParam>()));
  const double epsilon = std::log2(static_cast<double>(std::numeric_limits<TypeParam>::epsilon()));
  EXPECT_NEAR(exponent, 0.75 * epsilon, 0.5);  // because it is a power of two
}

TYPED_TEST(RayFormula, TCountsInDirectionLengths) {
  using Real = TypeParam;
  Random<Real> random(1);
  for (int i = 0; i < 200; ++i) {
    const Ray<Real> ray{random.vector(10), random.direction()};
    const Ray<Real> longer{ray.origin, Real(4) * ray.direction};
    const Real t = random.real(-10, 10);
    // because 4 is a power of two nothing is rounded differently.
    EXPECT_EQ(formulas::point_at(ray, t), formulas::point_at(longer, t / 4));
  }
}

template <class Real>
class SphereFormula : public testing::Test {
 protected:
  static std::optional<Real> hit(const Vec3<Real>& origin, const Vec3<Real>& direction,
                                 const Vec3<Real>& center, Real radius) {
    return formulas::intersect_sphere(Ray<Real>{origin, direction}, center, radius, false);
  }
};
TYPED_TEST_SUITE(SphereFormula, tests::Reals);

TYPED_TEST(SphereFormula, OfTwoRootsTheSmallerIsTheHit) {
  using Real = TypeParam;
  // From z = 5 to the unit sphere about 0: z = 1 at t = 4, z = -1 at t = 6.
  EXPECT_EQ(this->hit({0, 0, 5}, {0, 0, -1}, Vec3<Real>(0), 1), Real(4));
}

TYPED_TEST(SphereFormula, FromInsideTheOnlyPositiveRootIsTheHit) {
  using Real = TypeParam;
  // From z = 1 in a sphere of radius 4 about 0: z = -4 at t = 5; t = -3 lies behind.
  EXPECT_EQ(this->hit({0, 0, 1}, {0, 0, -1}, Vec3<Real>(0), 4), Real(5));
}

TYPED_TEST(SphereFormula, ASphereBehindTheOriginIsMissed) {
  using Real = TypeParam;
  EXPECT_EQ(this->hit({0, 0, 5}, {0, 0, 1}, Vec3<Real>(0), 1), std::nullopt);
}

TYPED_TEST(SphereFormula, ATangentHasOneDoubleRoot) {
  using Real = TypeParam;
  // b^2 - a c = 25 - 1 * (26 - 1) = 0: t = 5 at (1, 0, 0).
  EXPECT_EQ(this->hit({1, 0, 5}, {0, 0, -1}, Vec3<Real>(0), 1), Real(5));
}

TYPED_TEST(SphereFormula, ALineBesideTheSphereMisses) {
  using Real = TypeParam;
  // 1.25 from the axis of a unit sphere.
  EXPECT_EQ(this->hit({Real(1.25), 0, 5}, {0, 0, -1}, Vec3<Real>(0), 1), std::nullopt);
}

TYPED_TEST(SphereFormula, AnArbitraryCentreShiftsTheSphere) {
  using Real = TypeParam;
  // Along +x from 0 toward a centre at x = 10 of radius 3: x = 7.
  EXPECT_EQ(this->hit({0, 2, -3}, {1, 0, 0}, Vec3<Real>(10, 2, -3), 3), Real(7));
}

TYPED_TEST(SphereFormula, ALongerDirectionShortensT) {
  using Real = TypeParam;
  EXPECT_EQ(this->hit({0, 0, 5}, {0, 0, -8}, Vec3<Real>(0), 1), Real(0.5));
}

TYPED_TEST(SphereFormula, EveryHitSolvesTheImplicitEquation) {
  using Real = TypeParam;
  Random<Real> random(2);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3<Real> center = random.vector(6);
    const Ray<Real> ray = random.ray_near(center);
    const Real radius = random.real(0.5, 6);
    const auto t = formulas::intersect_sphere(ray, center, radius, false);
    if (!t) continue;
    ++hits;
    ASSERT_GT(*t, 0);
    const Implicit at = implicit_at(ray, center, radius, static_cast<Exact>(*t));
    EXPECT_LE(std::abs(at.value), root_tolerance<Real> * at.size);
  }
  EXPECT_GT(hits, 500);
}

TYPED_TEST(SphereFormula, NothingOfTheSurfaceLiesBeforeTheHit) {
  using Real = TypeParam;
  Random<Real> random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> center = random.vector(5);
    const Ray<Real> ray = random.ray_near(center);
    const Real radius = random.real(0.5, 6);
    const auto t = formulas::intersect_sphere(ray, center, radius, false);
    if (!t) continue;
    const bool outside = implicit_at(ray, center, radius, 0).value > 0;
    for (int k = 1; k < 20; ++k) {
      const Implicit at = implicit_at(ray, center, radius, static_cast<Exact>(*t) * k / 20);
      // because a root may be off by its tolerance, the sign is unsure only within it.
      const Exact unsure = root_tolerance<Real> * at.size;
      EXPECT_GT(outside ? at.value : -at.value, -unsure);
    }
  }
}

TYPED_TEST(SphereFormula, ARayHitsFromOutsideExactlyWhenItComesNearerThanTheRadius) {
  using Real = TypeParam;
  Random<Real> random(4);
  int hits = 0;
  int misses = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3<Real> center = random.vector(6);
    const Ray<Real> ray = random.ray_near(center);
    const Real radius = random.real(0.5, 4);
    const Implicit start = implicit_at(ray, center, radius, 0);
    if (start.value <= 0) continue;
    const Exact distance = nearest_approach_squared(ray, center);
    const Exact r = radius;
    // because the discriminant is a (r^2 - distance^2), with its roundings it decides outside this band.
    if (std::abs(distance - r * r) < root_tolerance<Real> * start.size) continue;
    const bool hit = formulas::intersect_sphere(ray, center, radius, false).has_value();
    EXPECT_EQ(hit, distance < r * r);
    ++(hit ? hits : misses);
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(misses, 200);
}

TYPED_TEST(SphereFormula, ARayFromInsideAlwaysHits) {
  using Real = TypeParam;
  Random<Real> random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> center = random.vector(5);
    const Real radius = random.real(0.5, 4);
    const Vec3<Real> inside = center + glm::normalize(random.direction()) * radius * random.real(0, 0.99);
    const auto t = formulas::intersect_sphere(Ray<Real>{inside, random.direction()}, center, radius, false);
    EXPECT_TRUE(t.has_value());
  }
}

TYPED_TEST(SphereFormula, ARayThatStartsOnTheSphereAndGoesInMeetsTheOtherSide) {
  using Real = TypeParam;
  Random<Real> random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> center = random.vector(5);
    const Real radius = random.real(0.5, 4);
    const Vec3<Real> outward = glm::normalize(random.direction());
    Vec3<Real> direction = random.direction();
    if (glm::dot(direction, outward) > 0) direction = -direction;
    if (glm::dot(direction, outward) > Real(-0.05)) continue;
    const Ray<Real> ray{center + radius * outward, direction};
    const auto t = formulas::intersect_sphere(ray, center, radius, true);
    ASSERT_TRUE(t.has_value());
    // A chord is 2 r cos(angle to the diameter) long.
    const Exact cosine = -glm::dot(glm::normalize(Vec3<Exact>(direction)), Vec3<Exact>(outward));
    const Exact chord = 2 * static_cast<Exact>(radius) * cosine;
    const Exact length = static_cast<Exact>(*t) * glm::length(Vec3<Exact>(direction));
    // because the start is off the sphere by some 4 roundings of numbers up to 9, in all directions.
    EXPECT_LE(std::abs(length - chord), static_cast<Exact>(tests::ulps<Real>(8) * 9));
  }
}

TYPED_TEST(SphereFormula, ARayThatStartsOnTheSphereAndGoesOutNeverMeetsItAgain) {
  using Real = TypeParam;
  Random<Real> random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> center = random.vector(5);
    const Real radius = random.real(0.5, 4);
    const Vec3<Real> outward = glm::normalize(random.direction());
    Vec3<Real> direction = random.direction();
    if (glm::dot(direction, outward) < 0) direction = -direction;
    if (glm::dot(direction, outward) < Real(0.05)) continue;
    const Ray<Real> ray{center + radius * outward, direction};
    EXPECT_EQ(formulas::intersect_sphere(ray, center, radius, true), std::nullopt);
  }
}

TYPED_TEST(SphereFormula, ARootAtTheOriginIsBehindTheRayHoweverItIsRounded) {
  using Real = TypeParam;
  // From the pole of another sphere at the same place, through its middle.
  for (int ulps = -4; ulps <= 4; ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    const Ray<Real> inward{{0, 0, 1 + off}, {0, 0, -1}, formulas::resolution<Real>()};
    const auto t = formulas::intersect_sphere(inward, Vec3<Real>(0), Real(1), false);
    ASSERT_TRUE(t.has_value()) << ulps;
    EXPECT_NEAR(static_cast<double>(*t), 2, 8 * static_cast<double>(std::numeric_limits<Real>::epsilon()));
    const Ray<Real> outward{inward.origin, {0, 0, 1}, inward.t_min};
    EXPECT_FALSE(formulas::intersect_sphere(outward, Vec3<Real>(0), Real(1), false).has_value()) << ulps;
  }
}

TYPED_TEST(SphereFormula, WhatIsKnownOnAGrazedSphereIsMetThereHoweverItIsRounded) {
  using Real = TypeParam;
  // The line touches the unit sphere at its pole; root and so t there are of the size of sqrt(eps).
  for (int ulps = -tests::roundings_of_grazed<Real>(); ulps <= tests::roundings_of_grazed<Real>(); ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    Ray<Real> ray{{-2, 1 + off, 0}, {1, 0, 0}, 2 * formulas::resolution<Real>()};
    ray.t_known = 2;
    const auto t = formulas::intersect_sphere(ray, Vec3<Real>(0), Real(1), false);
    EXPECT_EQ(t.value_or(ray.t_known), ray.t_known) << ulps;
  }
}

TYPED_TEST(SphereFormula, AGrazedSphereThroughTheOriginIsBehindTheRayHoweverItIsRounded) {
  using Real = TypeParam;
  for (int ulps = -tests::roundings_of_grazed<Real>(); ulps <= tests::roundings_of_grazed<Real>(); ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    const Ray<Real> ray{{0, 1 + off, 0}, {1, 0, 0}, formulas::resolution<Real>()};
    EXPECT_FALSE(formulas::intersect_sphere(ray, Vec3<Real>(0), Real(1), false).has_value()) << ulps;
  }
}

TYPED_TEST(SphereFormula, EveryScaleGivesTheSameT) {
  using Real = TypeParam;
  Random<Real> random(8);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3<Real> center = random.vector(4);
    const Ray<Real> ray = random.ray_near(center);
    const Real radius = random.real(0.5, 6);
    const auto t = formulas::intersect_sphere(ray, center, radius, false);
    hits += t ? 1 : 0;
    for (const Real scale : {std::ldexp(Real(1), -20), std::ldexp(Real(1), 20)}) {
      const Ray<Real> scaled{scale * ray.origin, scale * ray.direction};
      // because a power of two scales every intermediate value without a rounding.
      EXPECT_EQ(formulas::intersect_sphere(scaled, scale * center, scale * radius, false), t);
    }
  }
  EXPECT_GT(hits, 50);
}

TYPED_TEST(SphereFormula, ANearRootKeepsItsDigitsBesideAFarOne) {
  using Real = TypeParam;
  // From z = 2^10 + 2^-4 toward a sphere of radius 2^10 about 0: t = 2^-4 beside 2^11 + 2^-4. Of the
  // numbers only c = 2^7 + 2^-8 takes part in a subtraction of like ones: it is exact in 29 bits, so float is
  // off by half a unit of 2^20, which is 2^-4 of c = 2^7.
  const Real t = this->hit({0, 0, Real(1024.0625)}, {0, 0, -1}, Vec3<Real>(0), 1024).value();
  const Real float_error = Real(std::numeric_limits<Real>::digits < 29 ? 0x1p-10 : 0);
  // because beside that a handful of roundings act on 2^-4 alone.
  EXPECT_NEAR(static_cast<double>(t), 0.0625,
              0.0625 * (tests::ulps<Real>(4) + static_cast<double>(float_error)));
}

TYPED_TEST(SphereFormula, ANearRootKeepsItsDigitsFromInside) {
  using Real = TypeParam;
  // 2^-10 inside a unit sphere and on the way out: (1 - 2^-10)^2 - 1 is exact in 21 bits.
  const Ray<Real> ray{{0, 0, 1 - Real(0x1p-10)}, {Real(0.3), Real(0.4), Real(0.7)}};
  const auto t = formulas::intersect_sphere(ray, Vec3<Real>(0), Real(1), false);
  ASSERT_TRUE(t.has_value());
  Exact low = 0;
  Exact high = 0.5L;
  for (int i = 0; i < 80; ++i) {  // bisection of the implicit equation, which rises from inside to outside
    const Exact middle = (low + high) / 2;
    (implicit_at(ray, Vec3<Real>(0), Real(1), middle).value < 0 ? low : high) = middle;
  }
  // because 8 half epsilons of t, and in the check an error of long double of 4 terms of about 1 over the
  // slope 1.4.
  const Exact tolerance =
      static_cast<Exact>(tests::ulps<Real>(4)) * low + 3 * std::numeric_limits<Exact>::epsilon();
  EXPECT_LE(std::abs(static_cast<Exact>(*t) - low), tolerance);
}

TYPED_TEST(SphereFormula, TheNormalPointsOutwardsAndIsAsLongAsTheRadius) {
  using Real = TypeParam;
  EXPECT_EQ(formulas::sphere_normal(Vec3<Real>(1, 2, 6), Vec3<Real>(1, 2, 3)), Vec3<Real>(0, 0, 3));
}

}  // namespace
}  // namespace plumb
