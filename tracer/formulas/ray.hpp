// Slide "Strahl": p(t) = p0 + t d.
#pragma once

#include <limits>

#include "tracer/formulas/real.hpp"

namespace plumb {

/// A half-line. Its direction needs no unit length: t counts in lengths of the direction.
template <class Real>
struct Ray {
  Vec3<Real> origin;
  Vec3<Real> direction;
  Real t_min = 0;  ///< by rounding, a hit up to this t cannot be told from the origin
  /// Along each axis, the most that a world vector of length 1 can measure in this space.
  Vec3<Real> world_length{1};
  Real t_known = std::numeric_limits<Real>::infinity();  ///< t of a light ahead, or of the nearest hit so far
};

namespace formulas {

/// No slide, a decision: the least difference that a ray tells apart, as a share of t or of the largest
/// coordinate of its origin. A surface is known to a few eps across; at a grazing angle phi that is eps / phi
/// along the ray. Down to phi = eps^(1/4) this stays below eps^(3/4), which is a power of two here: 1.8e-12
/// in double, 7.6e-6 in float.
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

/// No slide, a decision: hits about t are one place to this ray when they are at most this far apart. What is
/// at one place with the origin lies behind the ray. Of two shapes at one place the ray meets the first in
/// the order of the scene, of two faces of a box that of the first axis. It meets a box whose edge is there,
/// and a light there is not hidden. So two ways to compute one ray come to the same hit, though their
/// roundings differ.
template <class Real>
Real one_place(const Ray<Real>& ray, Real t) {
  return ray.t_min + resolution<Real>() * t;
}

/// No slide, a decision: the slope to a surface below which a ray grazes it. It is also the share of
/// one_place() within which a place lies on the surface: 16 roundings in double, none in float. Below this
/// slope so many roundings move t by more than its resolution.
template <class Real>
constexpr Real grazing_slope() {
  return Real(1) / 512;
}

/// No slide, a decision: true if a hit lies ahead of where the ray starts. Up to `rounding`, the resolution
/// at its origin, a hit cannot be told from the start.
template <class Real>
bool is_ahead(Real t, Real rounding) {
  return t > rounding;
}

/// No slide, a decision: true if a hit comes before the nearest so far. Within `rounding` they are one place,
/// and the first that was met is kept.
template <class Real>
bool is_nearer(Real t, Real nearest, Real rounding) {
  return t < nearest - rounding;
}

}  // namespace formulas
}  // namespace plumb
