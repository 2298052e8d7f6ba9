// Slides "Transformationen", "Zusammengesetzt, Inverse", "Anwendung" and "Objekttransformation".
#include "tracer/formulas/transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/matrix.hpp>

#include "tests/support/reals.hpp"
#include "tracer/formulas/quad.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb {
namespace {

using Exact = long double;
using ExactMatrix = glm::mat<4, 4, Exact, glm::highp>;

template <class Real>
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Real real(double low, double high) {
    return static_cast<Real>(std::uniform_real_distribution<double>(low, high)(engine_));
  }
  bool flip() { return std::uniform_int_distribution(0, 1)(engine_) == 1; }
  Vec3<Real> vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  /// Not normalised; never near 0.
  Vec3<Real> direction() {
    for (;;) {
      const Vec3<Real> v = vector(1);
      if (glm::dot(v, v) > Real(0.05)) return v * real(0.2, 5);
    }
  }
  /// Factors of 0.3 to 3, some of them mirror.
  Vec3<Real> factors() {
    Vec3<Real> by(real(0.3, 3), real(0.3, 3), real(0.3, 3));
    for (int axis = 0; axis < 3; ++axis) by[axis] = flip() ? by[axis] : -by[axis];
    return by;
  }
  /// Scales, rotations and translations in turn: sheared, as the rotations stand between the scales.
  Transform<Real> transform() {
    Transform<Real> all = formulas::scale(factors());
    all = formulas::compose(formulas::rotate(real(-180, 180), direction()), all);
    all = formulas::compose(formulas::scale(factors()), all);
    all = formulas::compose(formulas::translate(vector(5)), all);
    return formulas::compose(formulas::rotate(real(-180, 180), direction()), all);
  }

 private:
  std::mt19937 engine_;
};

template <class Real>
Exact largest(const glm::vec<3, Real, glm::highp>& v) {
  return std::max({std::abs(static_cast<Exact>(v.x)), std::abs(static_cast<Exact>(v.y)),
                   std::abs(static_cast<Exact>(v.z))});
}

template <class Real>
void expect_near(const Vec3<Real>& found, const Vec3<Exact>& expected, double tolerance) {
  EXPECT_LE(largest(Vec3<Exact>(found) - expected), static_cast<Exact>(tolerance))
      << "found " << found.x << " " << found.y << " " << found.z << ", expected " << expected.x << " "
      << expected.y << " " << expected.z;
}

template <class Real>
class TransformFormula : public testing::Test {
 protected:
  static Vec3<Real> rotated(Real degrees, const Vec3<Real>& axis, const Vec3<Real>& v) {
    return formulas::transform_vector(formulas::rotation_matrix(degrees, axis), v);
  }
};
TYPED_TEST_SUITE(TransformFormula, tests::Reals);

// --- Transformationen ------------------------------------------------------------------------

TYPED_TEST(TransformFormula, ATranslationMovesPoints) {
  using Real = TypeParam;
  const auto m = formulas::translate(Vec3<Real>(10, 20, 30)).matrix;
  EXPECT_EQ(formulas::transform_point(m, Vec3<Real>(1, 2, 3)), Vec3<Real>(11, 22, 33));
}

TYPED_TEST(TransformFormula, ATranslationDoesNotMoveVectors) {
  using Real = TypeParam;
  const auto m = formulas::translate(Vec3<Real>(10, 20, 30)).matrix;
  EXPECT_EQ(formulas::transform_vector(m, Vec3<Real>(1, 2, 3)), Vec3<Real>(1, 2, 3));
}

TYPED_TEST(TransformFormula, AScaleMultipliesEachCoordinate) {
  using Real = TypeParam;
  const auto m = formulas::scale(Vec3<Real>(2, -3, Real(0.5))).matrix;
  EXPECT_EQ(formulas::transform_point(m, Vec3<Real>(1, 2, 4)), Vec3<Real>(2, -6, 2));
  EXPECT_EQ(formulas::transform_vector(m, Vec3<Real>(1, 2, 4)), Vec3<Real>(2, -6, 2));
}

TYPED_TEST(TransformFormula, AQuarterTurnAboutXTakesYToZ) {
  using Real = TypeParam;
  // because the cosine of the rounded right angle is up to an epsilon, and sums round some more.
  expect_near(this->rotated(90, {1, 0, 0}, {0, 1, 0}), {0, 0, 1}, tests::ulps<Real>(2));
  expect_near(this->rotated(90, {1, 0, 0}, {0, 0, 1}), {0, -1, 0}, tests::ulps<Real>(2));
}

TYPED_TEST(TransformFormula, AQuarterTurnAboutYTakesZToX) {
  using Real = TypeParam;
  // because the cosine of the rounded right angle is up to an epsilon, and sums round some more.
  expect_near(this->rotated(90, {0, 1, 0}, {0, 0, 1}), {1, 0, 0}, tests::ulps<Real>(2));
  expect_near(this->rotated(90, {0, 1, 0}, {1, 0, 0}), {0, 0, -1}, tests::ulps<Real>(2));
}

TYPED_TEST(TransformFormula, AQuarterTurnAboutZTakesXToY) {
  using Real = TypeParam;
  // because the cosine of the rounded right angle is up to an epsilon, and sums round some more.
  expect_near(this->rotated(90, {0, 0, 1}, {1, 0, 0}), {0, 1, 0}, tests::ulps<Real>(2));
  expect_near(this->rotated(90, {0, 0, 1}, {0, 1, 0}), {-1, 0, 0}, tests::ulps<Real>(2));
}

TYPED_TEST(TransformFormula, AThirdOfATurnAboutTheDiagonalTakesXToYToZToX) {
  using Real = TypeParam;
  // because angle, sine, cosine, axis (2), products (2) and sums (2) round below 1: 8 halves of an epsilon.
  expect_near(this->rotated(120, {1, 1, 1}, {1, 0, 0}), {0, 1, 0}, tests::ulps<Real>(4));
  expect_near(this->rotated(120, {1, 1, 1}, {0, 1, 0}), {0, 0, 1}, tests::ulps<Real>(4));
  expect_near(this->rotated(120, {1, 1, 1}, {0, 0, 1}), {1, 0, 0}, tests::ulps<Real>(4));
}

TYPED_TEST(TransformFormula, AngleAndSenseOfATurnAboutAnyAxisAreMeasuredAsAsked) {
  using Real = TypeParam;
  Random<Real> random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3<Real> axis = random.direction();
    const Real degrees = random.real(-179, 179);
    const Vec3<Real> v = random.direction();
    const Vec3<Exact> k = glm::normalize(Vec3<Exact>(axis));
    const Vec3<Exact> before(v);
    const Vec3<Exact> after(this->rotated(degrees, axis, v));
    const Vec3<Exact> a = before - glm::dot(before, k) * k;
    const Vec3<Exact> b = after - glm::dot(after, k) * k;
    if (glm::length(a) < Exact(0.1) * glm::length(before)) continue;  // along the axis: no angle
    const Exact measured = std::atan2(glm::dot(k, glm::cross(a, b)), glm::dot(a, b));
    const Exact asked = static_cast<Exact>(degrees) * std::numbers::pi_v<Exact> / 180;
    // because 8 half epsilons of a component show up to 10 times enlarged in the part across the axis, the
    // angle of up to pi is rounded twice, and three components count.
    EXPECT_LE(std::abs(measured - asked), static_cast<Exact>(tests::ulps<Real>(4 * 10 + 6)));
  }
}

TYPED_TEST(TransformFormula, ATurnKeepsLengthAndTheHeightAlongTheAxis) {
  using Real = TypeParam;
  Random<Real> random(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3<Real> axis = random.direction();
    const Vec3<Real> v = random.direction();
    const Vec3<Exact> before(v);
    const Vec3<Exact> after(this->rotated(random.real(-720, 720), axis, v));
    const Vec3<Exact> k = glm::normalize(Vec3<Exact>(axis));
    // because 8 half epsilons act on each of three components of a vector of this length.
    const Exact tolerance = static_cast<Exact>(tests::ulps<Real>(4 * 3)) * glm::length(before);
    EXPECT_LE(std::abs(glm::length(after) - glm::length(before)), tolerance);
    EXPECT_LE(std::abs(glm::dot(after - before, k)), tolerance);
  }
}

TYPED_TEST(TransformFormula, TheLengthOfTheAxisDoesNotMatter) {
  using Real = TypeParam;
  // because a power of two rounds nothing.
  EXPECT_EQ(formulas::rotation_matrix(Real(33), Vec3<Real>(1, 2, -3)),
            formulas::rotation_matrix(Real(33), Vec3<Real>(16, 32, -48)));
}

TYPED_TEST(TransformFormula, TheOppositeAxisTurnsTheOtherWay) {
  using Real = TypeParam;
  EXPECT_EQ(formulas::rotation_matrix(Real(33), Vec3<Real>(1, 2, -3)),
            formulas::rotation_matrix(Real(-33), Vec3<Real>(-1, -2, 3)));
}

TYPED_TEST(TransformFormula, TheLastRowIsThatOfAnAffineMap) {
  using Real = TypeParam;
  Random<Real> random(3);
  for (int i = 0; i < 50; ++i) {
    const auto transform = random.transform();
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(transform.matrix[column][3], column == 3 ? 1 : 0);
      EXPECT_EQ(transform.inverse[column][3], column == 3 ? 1 : 0);
    }
  }
}

TYPED_TEST(TransformFormula, PointsHaveWOneAndVectorsWZero) {
  using Real = TypeParam;
  Random<Real> random(4);
  for (int i = 0; i < 200; ++i) {
    const auto m = random.transform().matrix;
    const Vec3<Real> p = random.vector(5);
    const glm::vec<4, Exact, glm::highp> as_point = ExactMatrix(m) * glm::vec<4, Exact, glm::highp>(p, 1);
    const glm::vec<4, Exact, glm::highp> as_vector = ExactMatrix(m) * glm::vec<4, Exact, glm::highp>(p, 0);
    // because 3 products and 3 sums round terms of at most 9 * 2 * 5 + 10 = 100.
    const double tolerance = tests::ulps<Real>(3) * 100;
    expect_near(formulas::transform_point(m, p), Vec3<Exact>(as_point), tolerance);
    expect_near(formulas::transform_vector(m, p), Vec3<Exact>(as_vector), tolerance);
  }
}

// --- Zusammengesetzt, Inverse ------------------------------------------------------------------

TYPED_TEST(TransformFormula, TRSScalesFirstThenRotatesThenTranslates) {
  using Real = TypeParam;
  const auto s = formulas::scale(Vec3<Real>(2, 1, 1));
  const auto r = formulas::rotate(Real(90), Vec3<Real>(0, 0, 1));
  const auto t = formulas::translate(Vec3<Real>(10, 0, 0));
  const auto trs = formulas::compose(t, formulas::compose(r, s));
  // (1, 0, 0) is scaled to (2, 0, 0), turned to (0, 2, 0), moved to (10, 2, 0).
  // because the cosine of a right angle is off by an epsilon, times 2; the sum with 10 rounds by 8 more.
  expect_near(formulas::transform_point(trs.matrix, Vec3<Real>(1, 0, 0)), {10, 2, 0}, tests::ulps<Real>(10));
}

TYPED_TEST(TransformFormula, StepsActInTheirOrder) {
  using Real = TypeParam;
  const std::vector<TransformStep> steps{Scale{{2, 1, 1}}, Rotate{90, {0, 0, 1}}, Translate{{10, 0, 0}}};
  const auto m = transform_of<Real>(steps).matrix;
  // Scaled, turned, moved as above; with the same tolerance, because of the same roundings.
  expect_near(formulas::transform_point(m, Vec3<Real>(1, 0, 0)), {10, 2, 0}, tests::ulps<Real>(10));
}

TYPED_TEST(TransformFormula, NoStepsAreTheIdentity) {
  using Real = TypeParam;
  EXPECT_EQ(transform_of<Real>({}).matrix, Mat4<Real>(1));
  EXPECT_EQ(transform_of<Real>({}).inverse, Mat4<Real>(1));
}

TYPED_TEST(TransformFormula, TheInverseOfATranslationMovesBack) {
  using Real = TypeParam;
  const auto inverse = formulas::translate(Vec3<Real>(1, 2, 3)).inverse;
  EXPECT_EQ(formulas::transform_point(inverse, Vec3<Real>(1, 2, 3)), Vec3<Real>(0));
}

TYPED_TEST(TransformFormula, TheInverseOfAScaleDivides) {
  using Real = TypeParam;
  const auto inverse = formulas::scale(Vec3<Real>(2, -4, Real(0.5))).inverse;
  EXPECT_EQ(formulas::transform_point(inverse, Vec3<Real>(2, 4, 1)), Vec3<Real>(1, -1, 2));
}

TYPED_TEST(TransformFormula, TheInverseOfARotationTurnsBack) {
  using Real = TypeParam;
  const auto turn = formulas::rotate(Real(50), Vec3<Real>(1, 2, 3));
  const auto opposite = formulas::rotation_matrix(Real(-50), Vec3<Real>(1, 2, 3));
  for (int column = 0; column < 3; ++column) {
    // because a product of three factors and a sum round entries below 1, in another order.
    expect_near(Vec3<Real>(turn.inverse[column]), Vec3<Exact>(Vec3<Real>(opposite[column])),
                tests::ulps<Real>(2));
  }
}

TYPED_TEST(TransformFormula, TheInverseOfAProductTakesEveryPointBack) {
  using Real = TypeParam;
  Random<Real> random(5);
  for (int i = 0; i < 300; ++i) {
    const auto transform = random.transform();
    const Vec3<Real> p = random.vector(5);
    const Vec3<Real> there = formulas::transform_point(transform.matrix, p);
    const Vec3<Real> back = formulas::transform_point(transform.inverse, there);
    // because the matrices of 5 steps carry some 5 * 8 half epsilons, of p's image of at most 9 * sqrt(3) * 5
    // + sqrt(3) * 5 = 87 units, and the inverse enlarges them by up to 1 / 0.3^2.
    expect_near(back, Vec3<Exact>(p), tests::ulps<Real>(2 * 20) * 87 / 0.09);
  }
}

/// Turns, moves and scales to and fro.
std::vector<TransformStep> long_chain(int links) {
  std::vector<TransformStep> steps;
  for (int i = 0; i < links; ++i) {
    steps.emplace_back(Rotate{37.0 * i + 5, {1, 2.0 + i % 3, -0.5}});
    steps.emplace_back(Scale{Vec3d(i % 2 == 0 ? 2 : 0.5)});
    steps.emplace_back(Translate{{0.3, -0.2, 0.1 * (i % 7)}});
  }
  return steps;
}

template <class Real>
double worst_entry_in_eps(const Mat4<Real>& m, const Mat4<Quad>& exact) {
  Quad worst = 0, largest = 0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      worst = std::max(worst, abs(Quad(m[column][row]) - exact[column][row]));
      largest = std::max(largest, abs(exact[column][row]));
    }
  }
  return static_cast<double>(worst / largest) / static_cast<double>(std::numeric_limits<Real>::epsilon());
}

TEST(Transform, AChainOfHundredsIsRoundedOnce) {
  const auto steps = long_chain(300);
  const Transform<Quad> exact = transform_of<Quad>(steps);
  // because rounding once leaves 0.5, and the wider type 900 times 2^-11
  EXPECT_LE(worst_entry_in_eps(transform_of<double>(steps).matrix, exact.matrix), 1);
  EXPECT_LE(worst_entry_in_eps(transform_of<double>(steps).inverse, exact.inverse), 1);
  EXPECT_LE(worst_entry_in_eps(transform_of<float>(steps).matrix, exact.matrix), 0.51);
  EXPECT_GT(worst_entry_in_eps(product_of<double>(steps).matrix, exact.matrix), 1) << "the test cannot fail";
}

TYPED_TEST(TransformFormula, TheInverseIsWhatGaussJordanWouldFind) {
  using Real = TypeParam;
  Random<Real> random(6);
  for (int i = 0; i < 300; ++i) {
    const auto transform = random.transform();
    // Numerically, by GLM's cofactors in long double: shares nothing with the product of the inverses.
    const ExactMatrix inverse = glm::inverse(ExactMatrix(transform.matrix));
    for (int column = 0; column < 4; ++column) {
      // because entries of M of at most 9 + 5 are off by 20 epsilons, and the inverse, at most 1 / 0.09,
      // stands on both sides of the error: |dM^-1| = |M^-1 dM M^-1|; the last column once more by M's 9
      // units.
      const double tolerance = tests::ulps<Real>(20) * 14 / (0.09 * 0.09) * 3;
      expect_near(Vec3<Real>(transform.inverse[column]), Vec3<Exact>(inverse[column]), tolerance);
    }
  }
}

TYPED_TEST(TransformFormula, TheInverseOfAProductIsTheProductOfTheInversesReversed) {
  using Real = TypeParam;
  const auto s = formulas::scale(Vec3<Real>(2, 4, 8));
  const auto t = formulas::translate(Vec3<Real>(8, 8, 8));
  // T S takes 1 to (10, 12, 16); its inverse subtracts first, then divides: exact in powers of two.
  const auto ts = formulas::compose(t, s);
  EXPECT_EQ(formulas::transform_point(ts.matrix, Vec3<Real>(1)), Vec3<Real>(10, 12, 16));
  EXPECT_EQ(formulas::transform_point(ts.inverse, Vec3<Real>(10, 12, 16)), Vec3<Real>(1));
}

// --- Anwendung -----------------------------------------------------------------------------------

TYPED_TEST(TransformFormula, TheNormalOfAScaledSlopeIsScaledByTheInverse) {
  using Real = TypeParam;
  // The plane x + y = 1 has the tangent (1, -1, 0) and the normal (1, 1, 0). Twice as wide: tangent
  // (2, -1, 0), normal (1/2, 1, 0); M n = (2, 1, 0) would be wrong.
  const auto wide = formulas::scale(Vec3<Real>(2, 1, 1));
  EXPECT_EQ(formulas::transform_normal(wide.inverse, Vec3<Real>(1, 1, 0)), Vec3<Real>(Real(0.5), 1, 0));
}

TYPED_TEST(TransformFormula, ATranslationDoesNotMoveNormals) {
  using Real = TypeParam;
  const auto moved = formulas::translate(Vec3<Real>(10, 20, 30));
  EXPECT_EQ(formulas::transform_normal(moved.inverse, Vec3<Real>(1, 2, 3)), Vec3<Real>(1, 2, 3));
}

TYPED_TEST(TransformFormula, NormalsStayPerpendicularToTheirSurface) {
  using Real = TypeParam;
  Random<Real> random(7);
  for (int i = 0; i < 500; ++i) {
    const auto transform = random.transform();
    const Vec3<Real> normal = random.direction();
    const Vec3<Real> tangent = glm::cross(normal, random.direction());
    if (glm::length(tangent) < Real(0.1)) continue;
    const Vec3<Exact> n(formulas::transform_normal(transform.inverse, normal));
    const Vec3<Exact> t(formulas::transform_vector(transform.matrix, tangent));
    // because 20 epsilons of |M^-1| |n| |M| |t|: the scales of M are at most 9, of M^-1 1 / 0.09.
    const Exact size = glm::length(Vec3<Exact>(normal)) * glm::length(Vec3<Exact>(tangent)) * 9 / Exact(0.09);
    EXPECT_LE(std::abs(glm::dot(n, t)), static_cast<Exact>(tests::ulps<Real>(2 * 20)) * size);
  }
}

TYPED_TEST(TransformFormula, NormalsStayOnTheirSideOfTheSurface) {
  using Real = TypeParam;
  Random<Real> random(8);
  for (int i = 0; i < 500; ++i) {
    const auto transform = random.transform();  // many of them mirror
    const Vec3<Real> normal = glm::normalize(random.direction());
    const Vec3<Exact> n(formulas::transform_normal(transform.inverse, normal));
    const Vec3<Exact> outwards(formulas::transform_vector(transform.matrix, normal));
    // n' . M n = n . n = 1, however M mirrors or shears.
    // because 20 epsilons of |M^-1| |M|, twice.
    EXPECT_LE(std::abs(glm::dot(n, outwards) - 1),
              static_cast<Exact>(tests::ulps<Real>(2 * 20)) * 9 / Exact(0.09));
  }
}

TYPED_TEST(TransformFormula, ARayHasAPointAndAVector) {
  using Real = TypeParam;
  const auto m =
      formulas::compose(formulas::translate(Vec3<Real>(1, 2, 3)), formulas::scale(Vec3<Real>(2))).matrix;
  const auto ray = formulas::transform_ray(m, Ray<Real>{{1, 1, 1}, {0, 0, -1}});
  EXPECT_EQ(ray.origin, Vec3<Real>(3, 4, 5));
  EXPECT_EQ(ray.direction, Vec3<Real>(0, 0, -2));  // not normalised
}

TYPED_TEST(TransformFormula, TMeansTheSamePointInBothSpaces) {
  using Real = TypeParam;
  Random<Real> random(9);
  for (int i = 0; i < 300; ++i) {
    const auto m = random.transform().matrix;
    const Ray<Real> ray{random.vector(5), random.direction()};
    const Real t = random.real(0, 10);
    const Vec3<Real> here = formulas::transform_point(m, formulas::point_at(ray, t));
    const Vec3<Real> there = formulas::point_at(formulas::transform_ray(m, ray), t);
    // because 6 roundings on each way act on coordinates of at most 9 * (5 + 10 * 9) * 2 + 10 < 2000.
    expect_near(here, Vec3<Exact>(there), tests::ulps<Real>(6) * 2000);
  }
}

}  // namespace
}  // namespace plumb
