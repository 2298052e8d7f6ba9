// The oracle's boxes against rational arithmetic, and in another way: face by face.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tests/support/exact.hpp"
#include "tracer/formulas/box.hpp"

namespace plumb::tests {
namespace {

struct Places {
  std::optional<Exact> first;  ///< the smallest t > 0 at which the ray is on a face
  bool only_touches = false;   ///< an edge or a corner, from outside
};

bool is_between(const Exact& value, double low, double high) {
  return Exact(low) <= value && value <= Exact(high);
}

/// Face by face: where the plane is met, and whether that point is in the rectangle, its border included.
Places met_by_faces(const Line& line, const Corners<double>& box) {
  const Exact3 o(line.origin);
  const Exact3 d(line.direction);
  std::vector<Exact> all;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    if (d.at[axis] == 0) continue;
    const Exact t = (Exact(face % 2 == 0 ? box.min[axis] : box.max[axis]) - o.at[axis]) / d.at[axis];
    bool is_inside = t > 0;
    for (int other = 0; other < 3 && is_inside; ++other) {
      if (other == axis) continue;
      is_inside = is_between(o.at[other] + t * d.at[other], box.min[other], box.max[other]);
    }
    if (is_inside) all.push_back(t);
  }
  if (all.empty()) return {};
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  bool starts_outside = false;
  for (int axis = 0; axis < 3; ++axis)
    starts_outside = starts_outside || !is_between(o.at[axis], box.min[axis], box.max[axis]);
  return {*least, starts_outside && *least == *most};
}

/// Powers of two, and 0, whose reciprocal is not needed.
bool has_exact_reciprocals(const Vec3d& v) {
  int exponent = 0;
  const auto is_exact = [&](double d) { return d == 0 || std::abs(std::frexp(d, &exponent)) == 0.5; };
  return is_exact(v.x) && is_exact(v.y) && is_exact(v.z);
}

struct BoxesMet : Met {
  int touches = 0;
};

void expect_same(const Line& line, const Corners<double>& box, BoxesMet& met) {
  const Places places = met_by_faces(line, box);
  const auto hit =
      formulas::intersect_box<Quad>(in_quad(line), {Vec3<Quad>(box.min), Vec3<Quad>(box.max)}, no_face);
  met.touches += places.only_touches ? 1 : 0;
  // It enters and leaves at one t, that Quad reckons twice: unless nothing is rounded, whether it counts as
  // met is a matter of the last of 113 bits, and the oracle leaves it open.
  if (places.only_touches && !hit && !has_exact_reciprocals(line.direction)) return;
  ASSERT_EQ(hit.has_value(), places.first.has_value());
  ++(hit ? met.hits : met.misses);
  // because t is a difference, a reciprocal and a product, each good to 2^-113
  const Exact share = Exact(1, boost::multiprecision::cpp_int(1) << 110);
  if (hit) {
    EXPECT_LE(abs(exact(hit->t) - *places.first), *places.first * share);
  }
}

Corners<double> any_box(Random& random) {
  const Vec3d one = random.vector(10);
  const Vec3d other = one + random.vector(5);
  return {glm::min(one, other), glm::max(one, other)};
}

/// A corner, an inner point of an edge, or one of a face.
Vec3d on_the_box(Random& random, const Corners<double>& box, int fixed_axes) {
  Vec3d point;
  const int first = random.whole(0, 2);
  for (int i = 0; i < 3; ++i) {
    const int axis = (first + i) % 3;
    const bool is_low = random.whole(0, 1) == 0;
    point[axis] =
        i < fixed_axes ? (is_low ? box.min[axis] : box.max[axis]) : random.real(box.min[axis], box.max[axis]);
  }
  return point;
}

TEST(ExactBox, RandomRays) {
  Random random(4);
  BoxesMet met;
  for (int i = 0; i < 2000; ++i) {
    const Corners<double> box = any_box(random);
    const Vec3d origin = random.vector(20);
    Line line{origin, on_the_box(random, box, 1) + random.vector(2) - origin};
    if (i % 5 == 0) line.direction[random.whole(0, 2)] = i % 2 == 0 ? 0.0 : -0.0;
    expect_same(line, box, met);
  }
  EXPECT_GT(met.hits, 500);
  EXPECT_GT(met.misses, 300);
}

TEST(ExactBox, RaysAtEdgesAndCornersAsNearAsDoublesCanAim) {
  Random random(5);
  BoxesMet met;
  for (int i = 0; i < 3000; ++i) {
    const Corners<double> box = any_box(random);
    const Vec3d origin = random.vector(20);
    expect_same({origin, on_the_box(random, box, 2 + i % 2) - origin}, box, met);
  }
  EXPECT_GT(met.hits, 500);
  EXPECT_GT(met.misses, 300);
}

TEST(ExactBox, RaysThroughEdgesAndCornersExactly) {
  // Whole numbers: the target lies on the box to the last bit; parallel rays run along edges and in faces.
  Random random(6);
  BoxesMet met;
  for (int i = 0; i < 3000; ++i) {
    const Vec3d one = random.wholes(8);
    const Vec3d other = one + Vec3d(random.whole(1, 6), random.whole(1, 6), random.whole(1, 6));
    const Corners<double> box{one, other};
    Vec3d target = on_the_box(random, box, 3);
    if (i % 2 == 0) target[random.whole(0, 2)] += 1;  // an edge, or beside it
    const Vec3d direction = random.wholes(4);
    if (direction == Vec3d(0)) continue;
    expect_same({target - double(random.whole(0, 7)) * direction, direction}, box, met);
  }
  EXPECT_GT(met.hits, 1000);
  EXPECT_GT(met.misses, 300);
  EXPECT_GT(met.touches, 300);
}

}  // namespace
}  // namespace plumb::tests
