// Slide "Quader".
#include "tracer/formulas/box.hpp"

#include <array>
#include <cmath>
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
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(engine_); }
  Vec3<Real> vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  Corners<Real> box() {
    const Vec3<Real> corner = vector(4);
    return {corner, corner + Vec3<Real>(real(0.5, 4), real(0.5, 4), real(0.5, 4))};
  }
  /// A third of the components is 0 or -0, but never all three.
  Vec3<Real> direction() {
    Vec3<Real> d = vector(2);
    const int free_axis = whole(0, 2);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != free_axis && whole(0, 1) == 0) d[axis] = whole(0, 1) == 0 ? Real(0) : -Real(0);
    }
    return d;
  }
  Vec3<Real> inside(const Corners<Real>& box, double from = 0.1, double to = 0.9) {
    return {box.min.x + real(from, to) * (box.max.x - box.min.x),
            box.min.y + real(from, to) * (box.max.y - box.min.y),
            box.min.z + real(from, to) * (box.max.z - box.min.z)};
  }
  /// About half of these meet the box.
  Ray<Real> ray_near(const Corners<Real>& box) {
    const Vec3<Real> d = direction();
    return {inside(box, -0.4, 1.4) - real(0, 4) * d, d};
  }

 private:
  std::mt19937 engine_;
};

struct BruteHit {
  Exact t = std::numeric_limits<Exact>::infinity();
  Face face = no_face;
  bool unsure = false;  ///< some plane is met too near an edge, or two planes too near one another
};

/// All six planes, each with all its points; the nearest that lies on the box and in front of the origin.
template <class Real>
BruteHit brute_force(const Ray<Real>& ray, const Corners<Real>& box, Face without = no_face) {
  // because both sides are off by some roundings of numbers below 2^7, and what is at one place is a tie:
  // such edges are left out.
  const Exact margin = 128 * 4 * static_cast<Exact>(std::numeric_limits<Real>::epsilon()) +
                       2 * static_cast<Exact>(formulas::resolution<Real>());
  BruteHit best;
  for (Face face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const Exact d = ray.direction[axis];
    if (d == 0 || face == without) continue;
    const Exact plane = face % 2 == 0 ? box.min[axis] : box.max[axis];
    const Exact t = (plane - static_cast<Exact>(ray.origin[axis])) / d;
    if (t <= 0) continue;
    bool on_box = true;
    bool near_edge = false;
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      const Exact p = static_cast<Exact>(ray.origin[other]) + t * static_cast<Exact>(ray.direction[other]);
      const Exact low = box.min[other];
      const Exact high = box.max[other];
      on_box = on_box && low <= p && p <= high;
      const bool parallel = ray.direction[other] == 0;  // then p is exact
      near_edge =
          near_edge ||
          (!parallel && (std::abs(p - low) < margin * (1 + t) || std::abs(p - high) < margin * (1 + t)));
    }
    best.unsure = best.unsure || near_edge;
    if (on_box && t < best.t) best = {t, face, best.unsure};
  }
  return best;
}

template <class Real>
void expect_like_brute_force(const std::optional<FaceHit<Real>>& hit, const BruteHit& brute) {
  ASSERT_EQ(hit ? hit->face : no_face, brute.face);
  if (!hit) return;
  // because a difference, a reciprocal and a product round by half an epsilon each; the check adds less.
  EXPECT_LE(std::abs(static_cast<Exact>(hit->t) - brute.t),
            static_cast<Exact>(tests::ulps<Real>(2)) * brute.t);
}

template <class Real>
class BoxFormula : public testing::Test {
 protected:
  static constexpr Corners<Real> unit{Vec3<Real>(-1), Vec3<Real>(1)};
  static std::optional<FaceHit<Real>> hit(const Vec3<Real>& origin, const Vec3<Real>& direction,
                                          Face start = no_face) {
    return formulas::intersect_box(Ray<Real>{origin, direction}, unit, start);
  }
};
TYPED_TEST_SUITE(BoxFormula, tests::Reals);

TYPED_TEST(BoxFormula, CentreAndEdgesGiveTheCorners) {
  using Real = TypeParam;
  const auto box = formulas::box_from_center(Vec3<Real>(1, 2, 3), Vec3<Real>(2, 4, 8));
  EXPECT_EQ(box.min, Vec3<Real>(0, 0, -1));
  EXPECT_EQ(box.max, Vec3<Real>(2, 4, 7));
}

TYPED_TEST(BoxFormula, ABoxFromItsCentreIsHitLikeTheBoxFromItsCorners) {
  using Real = TypeParam;
  Random<Real> random(1);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    // Quarters and whole numbers: centre and edges are exact.
    const Vec3<Real> min(Real(random.whole(-8, 8)) / 4, Real(random.whole(-8, 8)) / 4,
                         Real(random.whole(-8, 8)) / 4);
    const Vec3<Real> edges(Real(random.whole(1, 12)), Real(random.whole(1, 12)), Real(random.whole(1, 12)));
    const Corners<Real> box{min, min + edges};
    const auto same = formulas::box_from_center(min + edges / Real(2), edges);
    const Ray<Real> ray = random.ray_near(box);
    const auto a = formulas::intersect_box(ray, box, no_face);
    const auto b = formulas::intersect_box(ray, same, no_face);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++hits;
    EXPECT_EQ(a->t, b->t);
  }
  EXPECT_GT(hits, 50);
}

TYPED_TEST(BoxFormula, EachOfTheSixFacesIsHitFromItsOwnSide) {
  using Real = TypeParam;
  for (Face face = 0; face < 6; ++face) {
    Vec3<Real> origin(Real(0.25));
    Vec3<Real> direction(0);
    origin[face / 2] = face % 2 == 0 ? Real(-5) : Real(5);
    direction[face / 2] = face % 2 == 0 ? Real(2) : Real(-2);
    const auto hit = this->hit(origin, direction);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->face, face);
    EXPECT_EQ(hit->t, Real(2));  // from 5 to 1 in steps of 2
  }
}

TYPED_TEST(BoxFormula, FromInsideTheFaceThatIsLeftIsHit) {
  using Real = TypeParam;
  const auto hit = this->hit({0, Real(0.5), 0}, {0, Real(0.25), 0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->face, 3);  // y max
  EXPECT_EQ(hit->t, Real(2));
}

TYPED_TEST(BoxFormula, ABoxBehindTheOriginIsMissed) {
  EXPECT_FALSE(this->hit({0, 0, 5}, {0, 0, 1}).has_value());
}

TYPED_TEST(BoxFormula, ARayBesideTheBoxMissesThoughItMeetsAllSixPlanes) {
  // y = x + 3: at x = -1 it is y = 2, at y = 1 it is x = -2.
  EXPECT_FALSE(this->hit({-5, -2, 0}, {1, 1, TypeParam(0.01)}).has_value());
}

TYPED_TEST(BoxFormula, ARayThroughTheCornerAloneHitsIt) {
  using Real = TypeParam;
  const auto hit = this->hit({2, 2, 2}, {-1, -1, -1});
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, Real(1));
}

TYPED_TEST(BoxFormula, AParallelRayOutsideTheSlabMisses) {
  using Real = TypeParam;
  for (const Real zero : {Real(0), -Real(0)}) {
    EXPECT_FALSE(this->hit({Real(1.5), 0, 5}, {zero, 0, -1}).has_value());
    EXPECT_FALSE(this->hit({Real(-1.5), 0, 5}, {zero, 0, -1}).has_value());
  }
}

TYPED_TEST(BoxFormula, NegativeZeroIsTheSameAsZero) {
  using Real = TypeParam;
  Random<Real> random(2);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto box = random.box();
    Ray<Real> ray = random.ray_near(box);
    const auto plain = formulas::intersect_box(ray, box, no_face);
    for (int axis = 0; axis < 3; ++axis) {
      if (ray.direction[axis] == 0) ray.direction[axis] = -ray.direction[axis];
    }
    const auto negated = formulas::intersect_box(ray, box, no_face);
    ASSERT_EQ(plain.has_value(), negated.has_value());
    if (!plain) continue;
    ++hits;
    EXPECT_EQ(plain->t, negated->t);
    EXPECT_EQ(plain->face, negated->face);
  }
  EXPECT_GT(hits, 200);
}

TYPED_TEST(BoxFormula, EveryRayHitsWhatBruteForceOverTheSixPlanesHits) {
  using Real = TypeParam;
  Random<Real> random(3);
  int hits = 0;
  int misses = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto box = random.box();
    const Ray<Real> ray = random.ray_near(box);
    const BruteHit brute = brute_force(ray, box);
    if (brute.unsure) continue;
    ++(brute.face == no_face ? misses : hits);
    expect_like_brute_force(formulas::intersect_box(ray, box, no_face), brute);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 300);
}

TYPED_TEST(BoxFormula, EveryRayFromInsideLeavesWhereBruteForceSays) {
  using Real = TypeParam;
  Random<Real> random(4);
  int sure = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto box = random.box();
    const Ray<Real> ray{random.inside(box), random.direction()};
    const BruteHit brute = brute_force(ray, box);
    if (brute.unsure) continue;
    ++sure;
    ASSERT_NE(brute.face, no_face);
    expect_like_brute_force(formulas::intersect_box(ray, box, no_face), brute);
  }
  EXPECT_GT(sure, 1000);
}

TYPED_TEST(BoxFormula, OnlyFacesTowardTheViewerAreEnteredAndOnlyTheOthersAreLeft) {
  using Real = TypeParam;
  Random<Real> random(5);
  for (int i = 0; i < 3000; ++i) {
    const auto box = random.box();
    const bool from_inside = i % 2 == 0;
    const Vec3<Real> origin = from_inside ? random.inside(box) : box.min - Vec3<Real>(random.real(0.1, 3));
    const Ray<Real> ray{origin, random.direction()};
    const auto hit = formulas::intersect_box(ray, box, no_face);
    if (!hit) continue;
    const Real along = ray.direction[hit->face / 2] * (hit->face % 2 == 0 ? Real(-1) : Real(1));
    EXPECT_EQ(along > 0, from_inside);
  }
}

TYPED_TEST(BoxFormula, AnOriginOnAFacePlaneIsHandledLikeBruteForce) {
  using Real = TypeParam;
  Random<Real> random(6);
  int hits = 0;
  int misses = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto box = random.box();
    const Face face = random.whole(0, 5);
    Ray<Real> ray{random.inside(box, -0.5, 1.5), random.direction()};
    ray.origin[face / 2] = face % 2 == 0 ? box.min[face / 2] : box.max[face / 2];
    const BruteHit brute = brute_force(ray, box);
    if (brute.unsure) continue;
    ++(brute.face == no_face ? misses : hits);
    expect_like_brute_force(formulas::intersect_box(ray, box, no_face), brute);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 300);
}

/// A ray from a face, its origin some roundings beside the plane on either side; `inwards` sets its sense.
template <class Real>
Ray<Real> ray_from_face(Random<Real>& random, const Corners<Real>& box, Face face, bool inwards) {
  Ray<Real> ray{random.inside(box), random.direction()};
  const int axis = face / 2;
  Real& at = ray.origin[axis];
  at = face % 2 == 0 ? box.min[axis] : box.max[axis];
  at += Real(random.whole(-4, 4)) * std::numeric_limits<Real>::epsilon() * at;
  const Real size = random.real(0.1, 1);
  ray.direction[axis] = (face % 2 == 0) == inwards ? size : -size;
  return ray;
}

TYPED_TEST(BoxFormula, ARayThatStartsOnAFaceAndGoesInLeavesByAnother) {
  using Real = TypeParam;
  Random<Real> random(7);
  int sure = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto box = random.box();
    const Face face = random.whole(0, 5);
    const auto ray = ray_from_face(random, box, face, true);
    const BruteHit brute = brute_force(ray, box, face);
    if (brute.unsure) continue;
    ++sure;
    ASSERT_NE(brute.face, no_face);
    expect_like_brute_force(formulas::intersect_box(ray, box, face), brute);
  }
  EXPECT_GT(sure, 1000);
}

TYPED_TEST(BoxFormula, ARayThatStartsOnAFaceAndGoesOutNeverMeetsTheBoxAgain) {
  using Real = TypeParam;
  Random<Real> random(8);
  for (int i = 0; i < 3000; ++i) {
    const auto box = random.box();
    const Face face = random.whole(0, 5);
    const auto ray = ray_from_face(random, box, face, false);
    EXPECT_FALSE(formulas::intersect_box(ray, box, face).has_value());
  }
}

TYPED_TEST(BoxFormula, ARayThatStartsOnAFaceIsInsideThoughRoundingPutsItBesideAnEdge) {
  using Real = TypeParam;
  // On x = -1, and just outside y = -1, which it crosses at once: it leaves at y = 1, not where it enters y.
  const Real outside = -1 - std::numeric_limits<Real>::epsilon();
  const auto hit = this->hit({-1, outside, 0}, {Real(0.25), 1, 0}, 0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->face, 3);
}

TYPED_TEST(BoxFormula, ARayThatStartsOnAFaceAtAnEdgeLeavesThere) {
  using Real = TypeParam;
  // Just before x = -1, where it starts, and nearer to y = 1: the plane it starts on is behind it all the
  // same.
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  const auto hit = this->hit({-1 - epsilon, 1 - epsilon, 0}, {1, 8, 0}, 0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->face, 3);
  EXPECT_EQ(hit->t, epsilon / 8);
}

TYPED_TEST(BoxFormula, ARayAlongTheFaceThatItStartsOnMeetsNothing) {
  using Real = TypeParam;
  for (const Real x : {Real(-1), Real(1)})
    for (const Real off :
         {Real(0), std::numeric_limits<Real>::epsilon(), -std::numeric_limits<Real>::epsilon()})
      EXPECT_FALSE(this->hit({x, 0, 0}, {off, 1, 0}, x < 0 ? 0 : 1).has_value()) << x << " " << off;
}

TYPED_TEST(BoxFormula, AtAnEdgeTheFirstAxisCountsHoweverTheRayIsRounded) {
  using Real = TypeParam;
  // Toward the edges of x = -1 and y = -1, of y = -1 and z = 1, and out of the one of x = 1 and z = -1.
  for (int ulps = -4; ulps <= 4; ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    EXPECT_EQ(this->hit({-2 + off, -2, 0}, {1, 1, 0})->face, 0) << ulps;
    EXPECT_EQ(this->hit({0, -2, 2 + off}, {0, 1, -1})->face, 2) << ulps;
    EXPECT_EQ(this->hit({off, 0, 0}, {1, 0, -1})->face, 1) << ulps;
  }
}

TYPED_TEST(BoxFormula, AnEdgeThatIsOnlyTouchedIsMetHoweverTheRayIsRounded) {
  using Real = TypeParam;
  // Past the edge of x = -1 and y = 1: it enters by x where it leaves by y.
  for (int ulps = -4; ulps <= 4; ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    const auto hit = this->hit({-2 + off, 0, 0}, {1, 1, 0});
    ASSERT_TRUE(hit.has_value()) << ulps;
    EXPECT_EQ(hit->face, 0) << ulps;
  }
  EXPECT_FALSE(this->hit({-2, Real(0.001), 0}, {1, 1, 0}).has_value()) << "that is past it";
}

TYPED_TEST(BoxFormula, ARayInThePlaneOfAFaceIsParallelToItHoweverItIsRounded) {
  using Real = TypeParam;
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  for (const Real tilt : {Real(0), epsilon, -epsilon, epsilon / 8}) {
    for (const Real beside : {Real(0), 2 * epsilon, -2 * epsilon}) {
      const Ray<Real> ray{{-3, 1 + beside, 0}, {1, tilt, 0}, 3 * formulas::resolution<Real>()};
      const auto hit = formulas::intersect_box(ray, this->unit, no_face);
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(hit->face, 0);
    }
  }
}

template <class Real>
Ray<Real> grazing_ray(Real height, Real slope) {
  return {{0, height, 0}, {1, slope, 0}, formulas::resolution<Real>()};
}

TYPED_TEST(BoxFormula, AGrazedPlaneThroughTheOriginIsBehindTheRayHoweverItIsRounded) {
  using Real = TypeParam;
  const Real slope = formulas::grazing_slope<Real>() / 100;
  for (int ulps = -tests::roundings_of_grazed<Real>(); ulps <= tests::roundings_of_grazed<Real>(); ++ulps) {
    // Inside, where the plane y = 1 is, and out by it: t of that plane would be off / slope, far over t_min.
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    EXPECT_FALSE(formulas::intersect_box(grazing_ray(1 + off, slope), this->unit, no_face).has_value())
        << ulps << ": it has left the box where it starts";
    const auto inward = formulas::intersect_box(grazing_ray(1 + off, -slope), this->unit, no_face);
    ASSERT_TRUE(inward.has_value()) << ulps;
    EXPECT_EQ(inward->face, 1) << ulps << ": it is in the box where it starts";
  }
}

TYPED_TEST(BoxFormula, AGrazedPlaneThroughWhatIsKnownIsMetThereHoweverItIsRounded) {
  using Real = TypeParam;
  const Real slope = formulas::grazing_slope<Real>() / 100;
  for (int ulps = -tests::roundings_of_grazed<Real>(); ulps <= tests::roundings_of_grazed<Real>(); ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    Ray<Real> ray = grazing_ray(1 - slope / 2 + off, slope);
    ray.t_known = Real(0.5);
    const auto hit = formulas::intersect_box(ray, this->unit, no_face);
    ASSERT_TRUE(hit.has_value()) << ulps;
    EXPECT_EQ(hit->t, ray.t_known) << ulps;
  }
}

TYPED_TEST(BoxFormula, WhatIsAtTheOriginIsBehindTheRay) {
  using Real = TypeParam;
  for (int ulps = -4; ulps <= 4; ++ulps) {
    const Real off = Real(ulps) * std::numeric_limits<Real>::epsilon();
    const Ray<Real> ray{{-1 + off, 0, 0}, {1, 0, 0}, formulas::resolution<Real>()};
    const auto hit = formulas::intersect_box(ray, this->unit, no_face);
    ASSERT_TRUE(hit.has_value()) << ulps;
    EXPECT_EQ(hit->face, 1) << ulps << ": the face of which the ray starts is entered already";
  }
}

TYPED_TEST(BoxFormula, EveryScaleGivesTheSameHit) {
  using Real = TypeParam;
  Random<Real> random(9);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const auto box = random.box();
    const Ray<Real> ray = random.ray_near(box);
    const auto hit = formulas::intersect_box(ray, box, no_face);
    for (const Real scale : {std::ldexp(Real(1), -40), std::ldexp(Real(1), 40)}) {
      const Ray<Real> scaled_ray{scale * ray.origin, scale * ray.direction, 0, Vec3<Real>(scale)};
      const auto scaled =
          formulas::intersect_box(scaled_ray, Corners<Real>{scale * box.min, scale * box.max}, no_face);
      ASSERT_EQ(hit.has_value(), scaled.has_value());
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(hit->t, scaled->t);  // because a power of two rounds nothing
      EXPECT_EQ(hit->face, scaled->face);
    }
  }
  EXPECT_GT(hits, 100);
}

TYPED_TEST(BoxFormula, NormalsPointOutOfTheSixFaces) {
  using Real = TypeParam;
  const std::array<Vec3<Real>, 6> outward{Vec3<Real>(-1, 0, 0), Vec3<Real>(1, 0, 0),  Vec3<Real>(0, -1, 0),
                                          Vec3<Real>(0, 1, 0),  Vec3<Real>(0, 0, -1), Vec3<Real>(0, 0, 1)};
  for (Face face = 0; face < 6; ++face) {
    EXPECT_EQ(formulas::box_normal<Real>(face), outward[static_cast<std::size_t>(face)]);
  }
}

}  // namespace
}  // namespace plumb
