// Slide "Spiegelung, Brechung": the reflected and the refracted ray.
#pragma once

#include <cmath>
#include <optional>

#include "tracer/formulas/real.hpp"

namespace plumb::formulas {

/// Slide "Spiegelung": r = d - 2 (d.n) n, which is as long as d. n is a unit vector.
template <class Real>
Vec3<Real> mirror_direction(const Vec3<Real>& d, const Vec3<Real>& n) {
  return d - 2 * glm::dot(d, n) * n;
}

/// Slide "Brechung", Snell's law: sin t = ratio sin i. The ratio is eta of the side that the ray comes from
/// over eta of the side that it goes to. d and n are unit vectors with d.n <= 0. The result is a unit vector,
/// or no value at total internal reflection. (Heckbert, "Writing a Ray Tracer", in Glassner, An Introduction
/// to Ray Tracing, 1989, section 5.)
template <class Real>
std::optional<Vec3<Real>> refracted_direction(const Vec3<Real>& d, const Vec3<Real>& n, Real ratio) {
  using std::sqrt;
  const Real cos_i = -glm::dot(d, n);
  const Real cos_t_squared = 1 - ratio * ratio * (1 - cos_i * cos_i);
  if (cos_t_squared < 0) return std::nullopt;
  return ratio * d + (ratio * cos_i - sqrt(cos_t_squared)) * n;
}

/// Decision: the recursion ends with trace(depth >= D), which is black; the first ray has depth 0. How many
/// rays of the pixel were traced before does not count.
constexpr bool is_too_deep(int depth, int limit, [[maybe_unused]] int rays_before) { return depth >= limit; }

/// Decision: total internal reflection has weight 1 and replaces the refracted and the mirrored ray.
template <class Real>
Rgb<Real> colour_at_total_reflection(const Rgb<Real>& local, const Rgb<Real>& reflected) {
  return local + reflected;
}

/// Decision: colour = local + kr R + kt T. The terms are added, without a Fresnel term.
template <class Real>
Rgb<Real> combined_colour(const Rgb<Real>& local, const Rgb<Real>& kr, const Rgb<Real>& mirrored,
                          const Rgb<Real>& kt, const Rgb<Real>& refracted) {
  return local + kr * mirrored + kt * refracted;
}

}  // namespace plumb::formulas
