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

}  // namespace formulas
}  // namespace plumb
