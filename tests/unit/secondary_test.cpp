// Slide "Spiegelung, Brechung".
#include "tracer/formulas/secondary.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/reals.hpp"

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
  Vec3<Real> unit() {
    for (;;) {
      const Vec3<Real> v(real(-1, 1), real(-1, 1), real(-1, 1));
      if (glm::dot(v, v) > Real(0.05)) return glm::normalize(v);
    }
  }
  /// A unit vector that comes down on the surface of the normal.
  Vec3<Real> onto(const Vec3<Real>& n) {
    const Vec3<Real> d = unit();
    return glm::dot(d, n) > 0 ? -d : d;
  }

 private:
  std::mt19937 engine_;
};

template <class Real>
Exact angle(const Vec3<Real>& a, const Vec3<Real>& b) {
  const Vec3<Exact> x(a);
  const Vec3<Exact> y(b);
  return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y));
}

template <class Real>
class SecondaryRay : public testing::Test {
 protected:
  static constexpr Exact epsilon = static_cast<Exact>(std::numeric_limits<Real>::epsilon());
  static Vec3<Real> up() { return {0, 1, 0}; }
  /// Comes down at so many radians from the normal (0, 1, 0), moving toward +x.
  static Vec3<Real> down_at(Exact radians) {
    return {static_cast<Real>(std::sin(radians)), static_cast<Real>(-std::cos(radians)), 0};
  }
};
TYPED_TEST_SUITE(SecondaryRay, tests::Reals);

// --- Spiegelung --------------------------------------------------------------------------------

TYPED_TEST(SecondaryRay, AMirrorTurnsTheComponentAlongTheNormal) {
  using Real = TypeParam;
  // Small whole numbers: exact.
  EXPECT_EQ(formulas::mirror_direction(Vec3<Real>(3, -4, 5), Vec3<Real>(0, 1, 0)), Vec3<Real>(3, 4, 5));
}

TYPED_TEST(SecondaryRay, AMirrorHitAtRightAnglesSendsTheRayBack) {
  using Real = TypeParam;
  EXPECT_EQ(formulas::mirror_direction(Vec3<Real>(0, -1, 0), Vec3<Real>(0, 1, 0)), Vec3<Real>(0, 1, 0));
}

TYPED_TEST(SecondaryRay, TheSignOfTheNormalDoesNotMatterToAMirror) {
  using Real = TypeParam;
  Random<Real> random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3<Real> d = random.unit();
    const Vec3<Real> n = random.unit();
    EXPECT_EQ(formulas::mirror_direction(d, n), formulas::mirror_direction(d, -n));
  }
}

TYPED_TEST(SecondaryRay, TheAngleOfIncidenceIsTheAngleOfReflection) {
  using Real = TypeParam;
  Random<Real> random(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> d = random.onto(n);
    const Vec3<Real> r = formulas::mirror_direction(d, n);
    // because n and d are unit up to 4 half epsilons each, n enters twice doubled, and 8 roundings follow.
    const Exact tolerance = 16 * this->epsilon;
    EXPECT_LE(std::abs(angle(r, n) - angle(-d, n)), tolerance);
    EXPECT_LE(std::abs(glm::length(Vec3<Exact>(r)) - 1), tolerance);
    // In one plane with d and n, and on the other side of the normal.
    EXPECT_LE(glm::length(glm::cross(Vec3<Exact>(r) - Vec3<Exact>(d), Vec3<Exact>(n))), tolerance);
  }
}

TYPED_TEST(SecondaryRay, MirroredTwiceIsAsBefore) {
  using Real = TypeParam;
  Random<Real> random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> d = random.unit();
    const Vec3<Real> twice = formulas::mirror_direction(formulas::mirror_direction(d, n), n);
    // because twice the tolerance of one mirror.
    EXPECT_LE(glm::length(Vec3<Exact>(twice) - Vec3<Exact>(d)), 32 * this->epsilon);
  }
}

// --- Brechung ------------------------------------------------------------------------------------

TYPED_TEST(SecondaryRay, SnellsLawHoldsForKnownAngles) {
  using Real = TypeParam;
  for (const Exact ratio : {1 / 1.5L, 1.5L, 1 / 1.33L, 1.33L, 1 / 2.4L, 2.4L, 1.0L}) {
    for (int degrees = 0; degrees < 90; degrees += 5) {
      const Exact incidence = degrees * std::numbers::pi_v<Exact> / 180;
      const Exact sine = ratio * std::sin(incidence);
      const auto bent =
          formulas::refracted_direction(this->down_at(incidence), this->up(), static_cast<Real>(ratio));
      EXPECT_EQ(bent.has_value(), sine < 1) << degrees << " degrees, ratio " << ratio;
      if (!bent || sine > Exact(0.99)) continue;
      const Exact expected = std::asin(sine);
      // because cos^2 t is off by some 8 half epsilons of ratio^2 < 6, and its root by that over 2 cos t,
      // with cos t > 0.14 when sin t < 0.99: 24 / 0.28.
      EXPECT_LE(std::abs(angle(-this->up(), *bent) - expected), 86 * this->epsilon)
          << degrees << " " << ratio;
    }
  }
}

TYPED_TEST(SecondaryRay, TheRefractedRayGoesThroughToTheSameSideOfTheNormal) {
  using Real = TypeParam;
  const auto bent = formulas::refracted_direction(this->down_at(Exact(0.5)), this->up(), Real(1) / Real(1.5));
  ASSERT_TRUE(bent.has_value());
  EXPECT_LT(bent->y, 0);  // below the surface
  EXPECT_GT(bent->x, 0);  // still toward +x
  EXPECT_EQ(bent->z, 0);
}

TYPED_TEST(SecondaryRay, IntoDenserGlassTheRayBendsTowardTheNormal) {
  using Real = TypeParam;
  const Vec3<Real> d = this->down_at(Exact(0.5));
  EXPECT_LT(formulas::refracted_direction(d, this->up(), Real(1) / Real(1.5))->x, d.x);
  EXPECT_GT(formulas::refracted_direction(d, this->up(), Real(1.5))->x, d.x);
}

TYPED_TEST(SecondaryRay, ARefractedRayIsAUnitVectorInThePlaneOfIncidence) {
  using Real = TypeParam;
  Random<Real> random(4);
  int bent_ones = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> d = random.onto(n);
    const Real ratio = random.real(0.4, 2.5);
    const auto bent = formulas::refracted_direction(d, n, ratio);
    if (!bent || -glm::dot(*bent, n) < Real(0.1)) continue;
    ++bent_ones;
    const Vec3<Exact> t(*bent);
    // because cos^2 t is off by 16 half epsilons (those of the unit vectors, too) of ratio^2 < 6.25, and its
    // root by that over 2 cos t > 0.2; sine and length carry no more.
    const Exact tolerance = 50 / Exact(0.2) * this->epsilon;
    EXPECT_LE(std::abs(glm::length(t) - 1), tolerance);
    EXPECT_LE(std::abs(glm::dot(t, glm::cross(Vec3<Exact>(d), Vec3<Exact>(n)))), tolerance);
    EXPECT_LE(std::abs(std::sin(angle(*bent, n)) - static_cast<Exact>(ratio) * std::sin(angle(d, n))),
              tolerance);
  }
  EXPECT_GT(bent_ones, 300);
}

TYPED_TEST(SecondaryRay, TotalReflectionBeginsAtTheCriticalAngle) {
  using Real = TypeParam;
  for (const Exact ratio : {1.5L, 1.33L, 2.4L, 1.01L}) {
    const Exact critical = 1 / ratio;  // sin of the angle of incidence whose sin t is 1
    // because ratio, sine, cosine and 5 operations round by half an epsilon: 8 of them suffice beside a root
    // that is not taken yet.
    const Exact step = 8 * this->epsilon;
    const auto below = this->down_at(std::asin(critical * (1 - step)));
    const auto above = this->down_at(std::asin(critical * (1 + step)));
    EXPECT_TRUE(formulas::refracted_direction(below, this->up(), static_cast<Real>(ratio)).has_value())
        << ratio;
    EXPECT_FALSE(formulas::refracted_direction(above, this->up(), static_cast<Real>(ratio)).has_value())
        << ratio;
  }
}

TYPED_TEST(SecondaryRay, IntoDenserGlassThereIsNoTotalReflection) {
  using Real = TypeParam;
  Random<Real> random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> n = random.unit();
    const Real ratio = i % 10 == 0 ? Real(1) : random.real(0.3, 1);
    EXPECT_TRUE(formulas::refracted_direction(random.onto(n), n, ratio).has_value());
  }
}

TYPED_TEST(SecondaryRay, TheWayOfLightIsReversible) {
  using Real = TypeParam;
  Random<Real> random(6);
  int reversed = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> d = random.onto(n);
    const Real ratio = random.real(0.4, 2.5);
    const auto bent = formulas::refracted_direction(d, n, ratio);
    if (!bent || -glm::dot(*bent, n) < Real(0.1) || -glm::dot(d, n) < Real(0.1)) continue;
    const auto back = formulas::refracted_direction(-*bent, -n, 1 / ratio);
    ASSERT_TRUE(back.has_value());
    ++reversed;
    // because each way is off by 50 / 0.2 epsilons as above, and the second enlarges the first's error of the
    // sine by 1 / ratio < 2.5 and, in the cosine, by at most 10.
    EXPECT_LE(glm::length(Vec3<Exact>(*back) + Vec3<Exact>(d)), 250 * (1 + 25) * this->epsilon);
  }
  EXPECT_GT(reversed, 300);
}

TYPED_TEST(SecondaryRay, EqualMediaDoNotBend) {
  using Real = TypeParam;
  Random<Real> random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> d = random.onto(n);
    if (glm::dot(d, n) > Real(-0.1)) continue;
    const auto bent = formulas::refracted_direction(d, n, Real(1));
    ASSERT_TRUE(bent.has_value());
    // because cos^2 t = cos^2 i is off by 2 roundings, its root by that over 2 cos i > 0.2.
    EXPECT_LE(glm::length(Vec3<Exact>(*bent) - Vec3<Exact>(d)), 2 / Exact(0.2) * this->epsilon);
  }
}

// --- the sum of both -----------------------------------------------------------------------------

TYPED_TEST(SecondaryRay, TheColoursAreAddedWithTheirWeightsPerChannel) {
  using Real = TypeParam;
  // r: 1 + 0.5 * 2 + 0 * 4 = 2; g: 1 + 0 * 2 + 0.25 * 4 = 2; b: 1 + 1 * 2 + 1 * 4 = 7, not clamped.
  const Rgb<Real> colour = formulas::combined_colour<Real>(Rgb<Real>(1), {Real(0.5), 0, 1}, Rgb<Real>(2),
                                                           {0, Real(0.25), 1}, Rgb<Real>(4));
  EXPECT_EQ(colour, Rgb<Real>(2, 2, 7));
}

}  // namespace
}  // namespace plumb
