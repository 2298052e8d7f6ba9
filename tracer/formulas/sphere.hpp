// Slide "Kugel": where a ray meets a sphere.
#pragma once

#include <cmath>
#include <optional>

#include "tracer/formulas/ray.hpp"

namespace plumb::formulas {

/// No slide, a decision: the t at which a ray crosses a sphere, with the rule of plane_crossed_at() for rays
/// that graze. `root` is the root of a quarter of the discriminant, `t` the solution; `offset` leads from the
/// centre to the origin.
template <class Real>
Real sphere_crossed_at(const Ray<Real>& ray, const Vec3<Real>& offset, Real radius, Real root, Real t) {
  using std::abs;
  const Vec3<Real> across = glm::abs(offset + t * ray.direction);
  const Real few_roundings = grazing_slope<Real>() * glm::dot(across, ray.world_length) / radius;
  if (!(root <= few_roundings * radius)) return t;
  const auto is_on_it = [&](Real at, Real rounding) {
    return abs(glm::length(offset + at * ray.direction) - radius) < rounding * few_roundings;
  };
  const auto is_at = [&](Real known, Real rounding) {
    return is_on_it(known, rounding) && is_on_it((known + t) / 2, rounding);
  };
  if (is_at(0, one_place(ray, Real(0)))) return 0;
  return is_at(ray.t_known, one_place(ray, ray.t_known)) ? ray.t_known : t;
}

/// Slide "Kugel": the smallest positive root of a t^2 + b t + c = 0 with a = d.d, b = 2 d.(p0 - m), c = (p0 -
/// m)^2 - r^2, or no value for a miss. A tangent has one double root. A root up to t_min is 0 by all that
/// rounding can tell, so the other one counts.
/// When the ray starts on this very sphere, one root is 0 and c vanishes. The other is -b/a, so no epsilon is
/// needed to leave the surface.
/// The roots are taken as q/a and c/q, which do not cancel (Press et al., Numerical Recipes, 3rd ed. 2007,
/// section 5.6). A quarter of the discriminant is a (r^2 - e^2), where e is the distance of the centre from
/// the line. b^2 - 4 a c would cancel where a sphere is small and far (Hearn and Baker; Haines et al.,
/// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, chapter 7).
template <class Real>
std::optional<Real> intersect_sphere(const Ray<Real>& ray, const Vec3<Real>& center, Real radius,
                                     bool starts_on_it) {
  using std::sqrt;
  const Vec3<Real> offset = ray.origin - center;
  const Real a = glm::dot(ray.direction, ray.direction);
  const Real half_b = glm::dot(offset, ray.direction);
  if (starts_on_it) {
    const Real t = -2 * half_b / a;
    return t > ray.t_min ? std::optional<Real>(t) : std::nullopt;  // a miss when it is infinity over infinity
  }
  const Real c = glm::dot(offset, offset) - radius * radius;
  if (c > 0 && half_b >= 0) return std::nullopt;  // outside and moving away
  const Vec3<Real> across = offset - half_b / a * ray.direction;
  const Real discriminant = a * (radius * radius - glm::dot(across, across));
  if (!(discriminant >= 0)) return std::nullopt;
  const Real root = sqrt(discriminant);
  const Real q = root - half_b;  // does not cancel when the ray moves toward the centre
  const auto crossed_at = [&](Real t) { return sphere_crossed_at(ray, offset, radius, root, t); };
  const Real enter = half_b < 0 ? crossed_at(c / q) : Real(0);
  const Real t = enter > ray.t_min ? enter : crossed_at(half_b >= 0 ? -c / (half_b + root) : q / a);
  return t > ray.t_min ? std::optional<Real>(t) : std::nullopt;
}

/// Outward normal at a point of the sphere. It is not normalised: its length is the radius.
template <class Real>
Vec3<Real> sphere_normal(const Vec3<Real>& point, const Vec3<Real>& center) {
  return point - center;
}

}  // namespace plumb::formulas
