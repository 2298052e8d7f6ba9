// Slide "Strahl": p(t) = p0 + t d.
#pragma once

#include "tracer/formulas/real.hpp"

namespace plumb {

/// A half-line. The direction needs no unit length: t counts in direction lengths.
template <class Real>
struct Ray {
  Vec3<Real> origin;
  Vec3<Real> direction;
};

namespace formulas {

/// Slide "Strahl": the point p0 + t d, in the space of the ray.
template <class Real>
Vec3<Real> point_at(const Ray<Real>& ray, Real t) {
  return ray.origin + t * ray.direction;
}

/// No slide, a decision: whether a hit lies ahead of where the ray starts. Up to `rounding`, the error of the
/// origin, it cannot be told from the start.
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
