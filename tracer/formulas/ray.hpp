// Slide "Strahl": p(t) = p0 + t d.
#pragma once

#include <limits>

#include "tracer/formulas/real.hpp"

namespace plumb {

/// A half-line. The direction needs no unit length: t counts in direction lengths.
template <class Real>
struct Ray {
  Vec3<Real> origin;
  Vec3<Real> direction;
  Real t_min = 0;  ///< rounding cannot tell hits up to here from the origin
  /// Along each axis, the most that a length of 1 in the world comes to in this space.
  Vec3<Real> world_length{1};
  Real t_known = std::numeric_limits<Real>::infinity();  ///< of a light ahead, or of the nearest hit so far
};

namespace formulas {

/// No slide, a decision: what a ray tells apart, as a share of t or of the largest coordinate of its origin.
/// A surface is known to a few eps across; at a grazing angle phi that is eps / phi along the ray. Down to
/// phi = eps^(1/4) that stays below eps^(3/4), here as a power of two: 1.8e-12 in double, 7.6e-6 in float.
template <class Real>
constexpr Real resolution() {
  Real share = 1;
  for (int bit = 0; bit < 3 * (std::numeric_limits<Real>::digits - 1) / 4; ++bit) share /= 2;
  return share;
}

/// Slide "Strahl": the point p0 + t d, in the space of the ray.
template <class Real>
Vec3<Real> point_at(const Ray<Real>& ray, Real t) {
  return ray.origin + t * ray.direction;
}

/// No slide, a decision: hits about t that are no farther apart are one place to this ray. What is at one
/// place with the origin lies behind the ray; of two shapes the first in the order of the scene is met there,
/// of two faces of a box the one of the first axis; a box whose edge is there is met; and a light there is
/// not hidden. Two ways to compute the same ray, whose roundings differ, so come to the same hit.
template <class Real>
Real one_place(const Ray<Real>& ray, Real t) {
  return ray.t_min + resolution<Real>() * t;
}

/// No slide, a decision: what a surface that is grazed tells apart, as a share of what t does: 16 roundings
/// of a place in double, none in float. Below this slope they are more than the resolution of t.
template <class Real>
constexpr Real grazing_slope() {
  return Real(1) / 512;
}

/// No slide, a decision: whether a hit lies ahead of where the ray starts. Up to `rounding`, the resolution
/// at its origin, it cannot be told from the start.
template <class Real>
bool is_ahead(Real t, Real rounding) {
  return t > rounding;
}

/// No slide, a decision: whether a hit comes before the nearest so far. Within `rounding` they are one place,
/// and the first that was met is kept.
template <class Real>
bool is_nearer(Real t, Real nearest, Real rounding) {
  return t < nearest - rounding;
}

}  // namespace formulas
}  // namespace plumb
