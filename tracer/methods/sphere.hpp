// Ways to intersect a sphere, each as an entry for formulas::intersect_sphere: same arguments, same result.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "tracer/formulas/ray.hpp"

namespace plumb::methods {

/// Returns the other root of a ray that starts on the sphere. All methods know their surface in the same way.
template <class Real>
std::optional<Real> chord(const Ray<Real>& ray, const Vec3<Real>& offset) {
  const Real half_b = glm::dot(offset, ray.direction);
  if (half_b < 0) return -2 * half_b / glm::dot(ray.direction, ray.direction);
  return std::nullopt;
}

/// Returns the first of two ordered roots that is positive.
template <class Real>
std::optional<Real> first_positive(Real near_t, Real far_t) {
  if (near_t > 0) return near_t;
  return far_t > 0 ? std::optional<Real>(far_t) : std::nullopt;
}

/// Slide "Kugel" to the letter: t = (-b -+ sqrt(b^2 - 4 a c)) / (2 a).
template <class Real>
std::optional<Real> sphere_naive(const Ray<Real>& ray, const Vec3<Real>& center, Real radius,
                                 bool starts_on_it) {
  using std::sqrt;
  const Vec3<Real> offset = ray.origin - center;
  if (starts_on_it) return chord(ray, offset);
  const Real a = glm::dot(ray.direction, ray.direction);
  const Real b = 2 * glm::dot(offset, ray.direction);
  const Real c = glm::dot(offset, offset) - radius * radius;
  const Real discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return std::nullopt;
  const Real root = sqrt(discriminant);
  return first_positive((-b - root) / (2 * a), (-b + root) / (2 * a));
}

/// Returns a b - c d with an error of at most 1.5 ulp, for types with std::fma (Kahan; Jeannerod, Louvet,
/// Muller, "Further analysis of Kahan's algorithm for the accurate computation of 2x2 determinants", Math.
/// Comp. 82, 2013).
template <class Real>
Real difference_of_products(Real a, Real b, Real c, Real d) {
  if constexpr (requires { std::fma(a, b, c); }) {
    const Real cd = c * d;
    const Real error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
  } else {
    return a * b - c * d;
  }
}

/// Returns the first positive root of a t^2 + 2 half_b t + c. The roots are taken as q/a and c/q, which do
/// not cancel (Press et al., Numerical Recipes, 3rd ed. 2007, section 5.6).
template <class Real>
std::optional<Real> stable_roots(Real a, Real half_b, Real c, Real discriminant) {
  using std::sqrt;
  if (!(discriminant >= 0)) return std::nullopt;
  const Real root = sqrt(discriminant);
  if (half_b > 0) return first_positive(-(half_b + root) / a, -c / (half_b + root));
  return first_positive(c / (root - half_b), (root - half_b) / a);
}

/// Kahan's discriminant ("On the Cost of Floating-Point Computation Without Extra-Precise Arithmetic", 2004).
/// It is exact to an ulp for the given coefficients, which are rounded themselves.
template <class Real>
std::optional<Real> sphere_kahan(const Ray<Real>& ray, const Vec3<Real>& center, Real radius,
                                 bool starts_on_it) {
  const Vec3<Real> offset = ray.origin - center;
  if (starts_on_it) return chord(ray, offset);
  const Real a = glm::dot(ray.direction, ray.direction);
  const Real half_b = glm::dot(offset, ray.direction);
  const Real c = glm::dot(offset, offset) - radius * radius;
  return stable_roots(a, half_b, c, difference_of_products(half_b, half_b, a, c));
}

/// Hearn and Baker's discriminant: r^2 less the squared distance of the centre from the line (Haines et al.,
/// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, chapter 7).
template <class Real>
std::optional<Real> sphere_haines(const Ray<Real>& ray, const Vec3<Real>& center, Real radius,
                                  bool starts_on_it) {
  const Vec3<Real> offset = ray.origin - center;
  if (starts_on_it) return chord(ray, offset);
  const Real a = glm::dot(ray.direction, ray.direction);
  const Real half_b = glm::dot(offset, ray.direction);
  const Vec3<Real> across = offset - half_b / a * ray.direction;
  const Real room = radius * radius - glm::dot(across, across);
  return stable_roots(a, half_b, glm::dot(offset, offset) - radius * radius, a * room);
}

/// The geometric way: half the chord, from squares of the radius, of the centre's distance and of that
/// distance along the ray (Haines, "Essential Ray Tracing Algorithms", in Glassner, An Introduction to Ray
/// Tracing, 1989, 2.2).
template <class Real>
std::optional<Real> sphere_geometric(const Ray<Real>& ray, const Vec3<Real>& center, Real radius,
                                     bool starts_on_it) {
  using std::sqrt;
  const Vec3<Real> to_center = center - ray.origin;
  if (starts_on_it) return chord(ray, -to_center);
  const Real length = sqrt(glm::dot(ray.direction, ray.direction));
  const Real along = glm::dot(to_center, ray.direction) / length;
  const Real squared = glm::dot(to_center, to_center);
  if (along < 0 && squared > radius * radius) return std::nullopt;
  const Real half_chord_squared = radius * radius - (squared - along * along);
  if (!(half_chord_squared >= 0)) return std::nullopt;
  const Real half_chord = sqrt(half_chord_squared);
  return first_positive((along - half_chord) / length, (along + half_chord) / length);
}

/// Any of these methods, but unaware of whether the ray starts on the sphere.
template <class Real, auto intersect>
std::optional<Real> sphere_unaware(const Ray<Real>& ray, const Vec3<Real>& center, Real radius, bool) {
  return intersect({ray.origin, ray.direction}, center, radius, false);
}

}  // namespace plumb::methods
