// Slides "Lambert", "Ambient", "Phong", "Vollstaendiges Modell" and "Schatten".
#include "tracer/formulas/phong.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
  Vec3<Real> vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  Vec3<Real> unit() {
    for (;;) {
      const Vec3<Real> v = vector(1);
      if (glm::dot(v, v) > Real(0.05)) return glm::normalize(v);
    }
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
class PhongFormula : public testing::Test {
 protected:
  /// In the plane z = 0, so many degrees from the y axis toward x.
  static Vec3<Real> at(double degrees) {
    const double a = degrees * 3.14159265358979323846 / 180;
    return {static_cast<Real>(std::sin(a)), static_cast<Real>(std::cos(a)), 0};
  }
  /// The directions of `at` are double, whatever the type.
  static constexpr double double_or_less = 2 * std::numeric_limits<double>::epsilon() + tests::ulps<Real>(2);
};
TYPED_TEST_SUITE(PhongFormula, tests::Reals);

// --- Lambert ---------------------------------------------------------------------------------

TYPED_TEST(PhongFormula, LambertIsTheCosineOfTheAngleToTheNormal) {
  using Real = TypeParam;
  const Vec3<Real> n(0, 1, 0);
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 120.0}) {
    const double expected = std::cos(degrees * 3.14159265358979323846 / 180);
    // because the direction is rounded once to double and once to Real.
    EXPECT_NEAR(static_cast<double>(formulas::diffuse_factor(n, this->at(degrees))), expected,
                this->double_or_less);
  }
}

TYPED_TEST(PhongFormula, ALightCountsOnlyInFrontOfTheSurface) {
  using Real = TypeParam;
  EXPECT_TRUE(formulas::light_counts(2 * formulas::resolution<Real>()));
  EXPECT_FALSE(formulas::light_counts(std::numeric_limits<Real>::epsilon())) << "rounding made it of 0";
  EXPECT_FALSE(formulas::light_counts(Real(0)));
  EXPECT_FALSE(formulas::light_counts(-Real(0)));
  EXPECT_FALSE(formulas::light_counts(Real(-0.5)));
}

TYPED_TEST(PhongFormula, TheWayToTheLightHasUnitLengthAndItsDistance) {
  using Real = TypeParam;
  // 3, 4, 5: exact but for the quotients.
  const auto toward = formulas::toward_light(Vec3<Real>(1, 1, 1), Vec3<Real>(4, 5, 1));
  EXPECT_EQ(toward.distance, Real(5));
  EXPECT_EQ(toward.direction, Vec3<Real>(Real(3) / 5, Real(4) / 5, 0));
}

TYPED_TEST(PhongFormula, DistanceTimesDirectionLeadsToTheLight) {
  using Real = TypeParam;
  Random<Real> random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3<Real> point = random.vector(10);
    const Vec3<Real> light = random.vector(10);
    const auto toward = formulas::toward_light(point, light);
    const Vec3<Exact> reached =
        Vec3<Exact>(point) + static_cast<Exact>(toward.distance) * Vec3<Exact>(toward.direction);
    // because difference and quotient round by half an epsilon each, of at most 20.
    EXPECT_LE(glm::length(reached - Vec3<Exact>(light)),
              static_cast<Exact>(tests::ulps<Real>(2)) * 20 * std::sqrt(Exact(3)));
    // because 3 squares, 2 sums, root and 3 quotients round by half an epsilon.
    EXPECT_LE(std::abs(glm::length(Vec3<Exact>(toward.direction)) - 1),
              static_cast<Exact>(tests::ulps<Real>(4)));
  }
}

TYPED_TEST(PhongFormula, TheNormalIsTurnedTowardTheViewer) {
  using Real = TypeParam;
  const Vec3<Real> n(0, 0, 1);
  EXPECT_EQ(formulas::facing_normal(n, Vec3<Real>(0, 0, -1)), n);
  EXPECT_EQ(formulas::facing_normal(n, Vec3<Real>(0, 0, 1)), -n);
  EXPECT_EQ(formulas::facing_normal(n, Vec3<Real>(1, 0, 0)), n);  // flipped only when n.d > 0
}

TYPED_TEST(PhongFormula, TheFacingNormalIsTheNormalUpToItsSignAndNeverLooksAway) {
  using Real = TypeParam;
  Random<Real> random(2);
  int flipped = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> d = random.unit();
    const Vec3<Real> facing = formulas::facing_normal(n, d);
    EXPECT_TRUE(facing == n || facing == -n);
    EXPECT_LE(glm::dot(facing, d), 0);
    flipped += facing == n ? 0 : 1;
  }
  EXPECT_GT(flipped, 50);
  EXPECT_LT(flipped, 250);
}

// --- Ambient -----------------------------------------------------------------------------------

TYPED_TEST(PhongFormula, AmbientLightIsWeightedPerChannel) {
  using Real = TypeParam;
  EXPECT_EQ(formulas::ambient_light(Rgb<Real>(1, 2, 4), Rgb<Real>(Real(0.5), Real(0.25), 0)),
            Rgb<Real>(Real(0.5), Real(0.5), 0));
}

// --- Phong -------------------------------------------------------------------------------------

TYPED_TEST(PhongFormula, TheLightIsMirroredAboutTheNormal) {
  using Real = TypeParam;
  // 3-4-5: from the upper left to the upper right.
  const Vec3<Real> r = formulas::reflected_light(Vec3<Real>(0, 1, 0), Vec3<Real>(Real(-0.6), Real(0.8), 0));
  EXPECT_EQ(r, Vec3<Real>(Real(0.6), Real(0.8), 0));
}

TYPED_TEST(PhongFormula, TheMirroredLightMakesTheSameAngleOnTheOtherSide) {
  using Real = TypeParam;
  Random<Real> random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3<Real> n = random.unit();
    const Vec3<Real> l = random.unit();
    const Vec3<Real> r = formulas::reflected_light(n, l);
    // because n and l are unit up to 4 half epsilons each, and r takes 2 n twice, with 8 roundings on the
    // way.
    const Exact tolerance = static_cast<Exact>(tests::ulps<Real>(16));
    EXPECT_LE(std::abs(angle(n, r) - angle(n, l)), tolerance);
    EXPECT_LE(std::abs(glm::length(Vec3<Exact>(r)) - 1), tolerance);
    const Vec3<Exact> middle = Vec3<Exact>(r) + Vec3<Exact>(l);  // along n, in one plane with it
    EXPECT_LE(glm::length(glm::cross(middle, Vec3<Exact>(n))), tolerance);
  }
}

/// Wherever the light is: its mirrored direction alone counts.
template <class Real>
Real highlight(const Vec3<Real>& r, const Vec3<Real>& v, Real m) {
  return formulas::specular_factor(r, v, Vec3<Real>(0, 0, 1), m);
}

TYPED_TEST(PhongFormula, TheHighlightIsThePowerOfTheCosine) {
  using Real = TypeParam;
  const Vec3<Real> r(0, 1, 0);
  const Vec3<Real> v(Real(0.8), Real(0.6), 0);
  // because r.v is 0.6 as rounded, the power rounds once more, and what is expected is a double.
  const double tolerance = std::max(tests::ulps<Real>(1), tests::ulps<double>(1));
  EXPECT_NEAR(static_cast<double>(highlight(r, v, Real(1))), 0.6, tolerance);
  EXPECT_NEAR(static_cast<double>(highlight(r, v, Real(2))), 0.36, tolerance);
  EXPECT_NEAR(static_cast<double>(highlight(r, v, Real(3))), 0.216, tolerance);
  EXPECT_NEAR(static_cast<double>(highlight(r, v, Real(0.5))), std::sqrt(0.6), tolerance);
}

TYPED_TEST(PhongFormula, TheHighlightIsFullInTheMirroredDirection) {
  using Real = TypeParam;
  EXPECT_EQ(highlight(Vec3<Real>(0, 1, 0), Vec3<Real>(0, 1, 0), Real(500)), Real(1));
}

TYPED_TEST(PhongFormula, BehindTheMirroredDirectionThereIsNoHighlight) {
  using Real = TypeParam;
  const Vec3<Real> r(0, 1, 0);
  for (const Real m : {Real(0), Real(1), Real(2), Real(0.5), Real(100)}) {  // an even power would be positive
    EXPECT_EQ(highlight(r, Vec3<Real>(Real(0.6), Real(-0.8), 0), m), Real(0));
  }
}

TYPED_TEST(PhongFormula, AcrossTheMirroredDirectionThereIsNoHighlightEvenWithExponentZero) {
  using Real = TypeParam;
  EXPECT_EQ(highlight(Vec3<Real>(0, 1, 0), Vec3<Real>(1, 0, 0), Real(0)), Real(0));
}

TYPED_TEST(PhongFormula, ExponentZeroGivesAHighlightEverywhereInFront) {
  using Real = TypeParam;
  EXPECT_EQ(highlight(Vec3<Real>(0, 1, 0), Vec3<Real>(1, Real(0.001), 0), Real(0)), Real(1));
  const Real rounding = std::numeric_limits<Real>::epsilon();
  EXPECT_EQ(highlight(Vec3<Real>(0, 1, 0), Vec3<Real>(1, rounding, 0), Real(0)), Real(0));
}

// --- Vollstaendiges Modell -------------------------------------------------------------------------

TYPED_TEST(PhongFormula, OneLightGivesDiffuseAndSpecularPerChannel) {
  using Real = TypeParam;
  // r: 2 * 1 * (0.5 * 0.5 + 0 * 0.25) = 0.5; g: 4 * 0.5 * (0.25 * 0.5 + 0.5 * 0.25) = 0.5;
  // b: 8 * 0.25 * (0 * 0.5 + 1 * 0.25) = 0.5: powers of two are exact.
  const Rgb<Real> found =
      formulas::reflected_intensity<Real>({2, 4, 8}, {1, Real(0.5), Real(0.25)}, {Real(0.5), Real(0.25), 0},
                                          Real(0.5), {0, Real(0.5), 1}, Real(0.25));
  EXPECT_EQ(found, Rgb<Real>(Real(0.5)));
}

TYPED_TEST(PhongFormula, TheIntensityIsLinearInTheLight) {
  using Real = TypeParam;
  Random<Real> random(4);
  for (int i = 0; i < 100; ++i) {
    const Rgb<Real> light(random.real(0, 2), random.real(0, 2), random.real(0, 2));
    const Rgb<Real> kd(random.real(0, 1), random.real(0, 1), random.real(0, 1));
    const Rgb<Real> ks(random.real(0, 1), random.real(0, 1), random.real(0, 1));
    const Real lambert = random.real(0, 1);
    const Real phong = random.real(0, 1);
    const auto once = formulas::reflected_intensity(light, Rgb<Real>(1), kd, lambert, ks, phong);
    const auto twice = formulas::reflected_intensity(Real(2) * light, Rgb<Real>(1), kd, lambert, ks, phong);
    EXPECT_EQ(twice, Real(2) * once);  // because 2 is a power of two
    EXPECT_GT(once.x, 0);
  }
}

TYPED_TEST(PhongFormula, AHiddenLightGivesNothing) {
  using Real = TypeParam;
  EXPECT_EQ(formulas::reflected_intensity<Real>(Rgb<Real>(9), Rgb<Real>(0), Rgb<Real>(1), 1, Rgb<Real>(1), 1),
            Rgb<Real>(0));
}

// --- Schatten --------------------------------------------------------------------------------------

TYPED_TEST(PhongFormula, ABlockerLiesStrictlyBetweenThePointAndTheLight) {
  using Real = TypeParam;
  const Real distance = 7;
  EXPECT_TRUE(formulas::blocks_light(Real(3), distance));
  EXPECT_TRUE(formulas::blocks_light(std::nextafter(distance, Real(0)), distance));
  EXPECT_TRUE(formulas::blocks_light(std::numeric_limits<Real>::denorm_min(), distance));
}

TYPED_TEST(PhongFormula, NothingAtThePointOrAtTheLightBlocks) {
  using Real = TypeParam;
  EXPECT_FALSE(formulas::blocks_light(Real(0), Real(7)));
  EXPECT_FALSE(formulas::blocks_light(Real(7), Real(7)));
}

TYPED_TEST(PhongFormula, NothingBeyondTheLightOrBehindThePointBlocks) {
  using Real = TypeParam;
  EXPECT_FALSE(formulas::blocks_light(std::nextafter(Real(7), Real(8)), Real(7)));
  EXPECT_FALSE(formulas::blocks_light(std::numeric_limits<Real>::infinity(), Real(7)));
  EXPECT_FALSE(formulas::blocks_light(Real(-3), Real(7)));
}

}  // namespace
}  // namespace plumb
