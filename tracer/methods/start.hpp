// Ways to keep a ray from meeting the surface that it starts on.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracer/formulas/phong.hpp"
#include "tracer/formulas/ray.hpp"

namespace plumb::methods {

/// An entry for formulas::is_ahead that ignores the rounding.
template <class Real>
bool ahead_of_zero(Real t, Real) {
  return t > 0;
}

/// Returns n or -n, whichever points to the side of the surface where the ray goes.
template <class Real>
Vec3<Real> side_of(const Vec3<Real>& n, const Vec3<Real>& direction) {
  return glm::dot(n, direction) < 0 ? -n : n;
}

/// Entries for formulas::secondary_origin: point, unit normal, direction.
/// The epsilon of most tracers, t > 1e-4 whatever the scene's size. No root before it counts, so the ray may
/// as well start there.
template <class Real>
Vec3<Real> epsilon_ahead(const Vec3<Real>& point, const Vec3<Real>&, const Vec3<Real>& direction) {
  return point + Real(1e-4) * direction;
}

/// Goes a fixed distance along the normal.
template <class Real>
Vec3<Real> normal_offset(const Vec3<Real>& point, const Vec3<Real>& n, const Vec3<Real>& direction) {
  return point + Real(1e-4) * side_of(n, direction);
}

/// Returns the distance from a number to the next. Numbers below the smallest normal float count as that.
template <class Real>
Real ulp_of(Real value) {
  using Wide = long double;  // a type that ldexp and ilogb know
  const Wide least = std::numeric_limits<float>::min();
  const Wide size = std::max(std::fabs(static_cast<Wide>(value)), least);
  return static_cast<Real>(std::ldexp(static_cast<Wide>(1), std::ilogb(size))) *
         std::numeric_limits<Real>::epsilon();
}

/// Goes 256 ulps along the normal, and 1/65536 near the origin (Waechter, Binder, "A Fast and Robust Method
/// for Avoiding Self-Intersection", Ray Tracing Gems, 2019, chapter 6). Their constants are for float; those
/// of wider types keep their ratio to epsilon.
template <class Real>
Vec3<Real> waechter_binder(const Vec3<Real>& point, const Vec3<Real>& n, const Vec3<Real>& direction) {
  using std::abs;
  const Real of_float = std::numeric_limits<Real>::epsilon() / Real(0x1p-23);
  const Vec3<Real> side = side_of(n, direction);
  Vec3<Real> origin;
  for (int i = 0; i < 3; ++i) {
    const bool is_near_zero = abs(point[i]) < Real(1.0 / 32);
    const Real step = is_near_zero ? Real(1.0 / 65536) * of_float : Real(256) * ulp_of(point[i]);
    origin[i] = point[i] + step * side[i];
  }
  return origin;
}

/// Goes along the normal by the bound of the point's error, |p| gamma(5), and then one ulp further (Pharr,
/// Jakob, Humphreys, Physically Based Rendering, 4th ed. 2023, section 6.8.6). The bound is that of a point
/// that was put back onto its sphere.
template <class Real>
Vec3<Real> error_bound(const Vec3<Real>& point, const Vec3<Real>& n, const Vec3<Real>& direction) {
  const Real half = std::numeric_limits<Real>::epsilon() / 2;
  const Real gamma = 5 * half / (1 - 5 * half);
  const Vec3<Real> side = side_of(n, direction);
  const Vec3<Real> origin = point + glm::dot(glm::abs(n), gamma * glm::abs(point)) * side;
  Vec3<Real> outward;
  for (int i = 0; i < 3; ++i)
    outward[i] = origin[i] + (side[i] > 0 ? 1 : side[i] < 0 ? -1 : 0) * ulp_of(origin[i]);
  return outward;
}

/// An entry for formulas::shadow_ray: starts where `origin` says and does not know its surface.
template <class Real, auto origin>
formulas::ShadowRay<Real> shadow_from(const Vec3<Real>& point, const Vec3<Real>& n,
                                      const formulas::Toward<Real>& to_light, const Vec3<Real>&) {
  return {{origin(point, n, to_light.direction), to_light.direction}, to_light.distance, false};
}

}  // namespace plumb::methods
