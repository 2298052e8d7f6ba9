// The oracle's spheres against rational arithmetic, and in another way: by the signs of the polynomial on
// both sides of t.
#include <gtest/gtest.h>

#include "tests/support/exact.hpp"
#include "tracer/formulas/sphere.hpp"

namespace plumb::tests {
namespace {

/// |p0 + t d - m|^2 - r^2 = a t^2 + 2 h t + c
class Polynomial {
 public:
  Polynomial(const Line& line, const Vec3d& center, double radius) {
    const Exact3 d(line.direction);
    Exact3 offset(line.origin);
    for (int axis = 0; axis < 3; ++axis) offset.at[axis] -= Exact(center[axis]);
    a_ = dot(d, d);
    h_ = dot(offset, d);
    c_ = dot(offset, offset) - Exact(radius) * Exact(radius);
    terms_ = static_cast<double>(a_ * (dot(offset, offset) + Exact(radius) * Exact(radius)));
  }

  Exact discriminant() const { return h_ * h_ - a_ * c_; }
  /// Whether it has a root > 0: outside, the product and the sum of the roots are positive.
  bool is_hit() const { return discriminant() >= 0 && (c_ < 0 || h_ < 0); }
  bool starts_outside() const { return c_ > 0; }
  Exact at(const Exact& t) const { return (a_ * t + 2 * h_) * t + c_; }
  /// Where it is least: between the roots.
  Exact middle() const { return -h_ / a_; }

  /// How far Quad's root may be off. The discriminant is a (r^2 - e^2); products of two doubles are exact,
  /// and what rounds h / a moves the foot along the ray, across which e stands, so it counts squared. In
  /// units of 2^-113 of the terms are left, at most: 4 of e^2 for the products with d and the differences, 3
  /// for the sum of its squares, 1 for r^2 - e^2, 2 for a, 1 for the product, together 11 of the 12. t
  /// follows it by 1 / (2 a root). What t has of its own, h, root, sum and quotient, is below 4 more. A
  /// double root of 0 discriminant, met exactly, has these alone.
  Exact rounding_of_root() const {
    const auto root = std::sqrt(static_cast<double>(discriminant()));
    const double of_discriminant = root > 0 ? 12 * terms_ / (2 * root) : 0;
    return Exact(0x1p-113 * (of_discriminant + 4 * std::sqrt(terms_))) / a_;
  }

 private:
  Exact a_, h_, c_;
  double terms_;  // a (|p0 - m|^2 + r^2): no term of the discriminant is larger
};

/// Whether t is the smallest root > 0: between t less its rounding and t with it the sign changes, from
/// outside before the middle, from inside after it.
void expect_root(const Polynomial& p, const Exact& t) {
  ASSERT_GT(t, 0);
  const Exact before = t - p.rounding_of_root();
  const Exact after = t + p.rounding_of_root();
  if (p.discriminant() == 0) {
    EXPECT_LE(before, p.middle());
    EXPECT_GE(after, p.middle());
    return;
  }
  const bool enters = p.starts_outside();
  EXPECT_GT(p.at(enters ? before : after), 0);
  EXPECT_TRUE(enters ? before < p.middle() : after > p.middle());
  const Exact& inside = enters ? after : before;
  const bool is_past_the_middle = enters ? inside > p.middle() : inside < p.middle();
  EXPECT_TRUE(is_past_the_middle || p.at(inside) < 0);
}

void expect_same(const Line& line, const Vec3d& center, double radius, Met& met) {
  const Polynomial p(line, center, radius);
  const auto t = formulas::intersect_sphere<Quad>(in_quad(line), Vec3<Quad>(center), Quad(radius), false);
  ASSERT_EQ(t.has_value(), p.is_hit()) << "discriminant " << static_cast<double>(p.discriminant());
  ++(t ? met.hits : met.misses);
  met.tangents += t && p.discriminant() == 0 ? 1 : 0;
  if (t) expect_root(p, exact(*t));
}

TEST(ExactSphere, RandomRays) {
  Random random(1);
  Met met;
  for (int i = 0; i < 2000; ++i) {
    const double radius = random.size(1e-3, 1e3);
    const Vec3d center = random.vector(10);
    const Vec3d origin = center + random.vector(radius * random.size(0.1, 1e4));
    const Vec3d target = center + random.vector(radius);
    expect_same({origin, (target - origin) * random.size(1e-3, 1e3)}, center, radius, met);
  }
  EXPECT_GT(met.hits, 500);
  EXPECT_GT(met.misses, 300);
}

TEST(ExactSphere, GrazingRays) {
  // Past the rim as closely as doubles can say, on either side.
  Random random(2);
  Met met;
  for (int i = 0; i < 2000; ++i) {
    const double radius = random.size(0.1, 10);
    const Vec3d center = random.vector(10);
    const Vec3d forth = glm::normalize(random.vector(1));
    const Vec3d aside = glm::normalize(glm::cross(forth, random.vector(1)));
    const Vec3d rim = center + radius * aside;
    expect_same({rim - forth * random.size(0.1, 100), forth}, center, radius, met);
  }
  EXPECT_GT(met.hits, 500);
  EXPECT_GT(met.misses, 500);
}

TEST(ExactSphere, Tangents) {
  // An orthogonal basis of whole numbers of whole length: (1, 2, 2), (2, 1, -2), (2, -2, 1), each 3 long.
  const Vec3d basis[] = {{1, 2, 2}, {2, 1, -2}, {2, -2, 1}};
  Random random(3);
  Met met;
  for (int i = 0; i < 500; ++i) {
    const int along = random.whole(0, 2);
    const double scale = random.whole(1, 9);
    const Vec3d center = random.wholes(20);
    const Vec3d touch = center + scale * basis[(along + 1) % 3];
    const Line line{touch - double(random.whole(1, 30)) * basis[along], basis[along]};
    expect_same(line, center, 3 * scale, met);
    expect_same(line, center, std::nextafter(3 * scale, 0), met);
    expect_same(line, center, std::nextafter(3 * scale, 100), met);
  }
  EXPECT_EQ(met.tangents, 500);
  EXPECT_EQ(met.misses, 500);
}

}  // namespace
}  // namespace plumb::tests
