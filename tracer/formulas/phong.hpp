// Slides "Lambert", "Ambient", "Phong", "Vollstaendiges Modell" and "Schatten". All directions are unit
// vectors.
#pragma once

#include <cmath>
#include <cstdint>

#include "tracer/formulas/ray.hpp"

namespace plumb::formulas {

/// Decision: n faces the viewer. It is flipped when n.d > 0, where d is the direction of the ray that sees
/// it.
template <class Real>
Vec3<Real> facing_normal(const Vec3<Real>& normal, const Vec3<Real>& direction) {
  return glm::dot(normal, direction) > 0 ? -normal : normal;
}

/// A ray that has hit something, and the eye from which all rays of the picture come; in world space.
template <class Real>
struct Sight {
  Vec3<Real> direction;  ///< of the ray, unit length
  Vec3<Real> point;      ///< where the ray hits
  Vec3<Real> eye;
};

/// Slide "Phong": v, from the point back along the ray that sees it. It leads to the eye for the first ray
/// only.
template <class Real>
Vec3<Real> toward_viewer(const Sight<Real>& sight) {
  return -sight.direction;
}

/// Slide "Lambert": n.l; a light counts only when this is positive.
template <class Real>
Real diffuse_factor(const Vec3<Real>& n, const Vec3<Real>& l) {
  return glm::dot(n, l);
}

/// Where the light is, as seen from a point.
template <class Real>
struct Toward {
  Vec3<Real> direction;  ///< l, unit length
  Real distance;
};

/// Slide "Lambert": l, normalised, from the point toward the light, and the light's distance.
template <class Real>
Toward<Real> toward_light(const Vec3<Real>& point, const Vec3<Real>& light) {
  const Vec3<Real> offset = light - point;
  const Real distance = glm::length(offset);
  return {offset / distance, distance};
}

/// Slide "Lambert": Ip, which is the same at every distance.
template <class Real>
Rgb<Real> arriving_light(const Rgb<Real>& intensity, [[maybe_unused]] Real distance) {
  return intensity;
}

/// Decision: true if a light counts, diffuse and specular: n.l > 0 by more than rounding can make of 0.
template <class Real>
bool light_counts(Real diffuse_factor) {
  return diffuse_factor > resolution<Real>();
}

/// Slide "Phong": r = 2 (n.l) n - l, the direction in which the surface mirrors the light.
template <class Real>
Vec3<Real> reflected_light(const Vec3<Real>& n, const Vec3<Real>& l) {
  return 2 * glm::dot(n, l) * n - l;
}

/// Slide "Phong": (r.v)^m. It is 0 when r.v <= 0, or when r.v is no more than rounding can make of 0: with m
/// = 0 the power would be 0 or 1 by chance.
template <class Real>
Real specular_factor(const Vec3<Real>& r, const Vec3<Real>& v, [[maybe_unused]] const Vec3<Real>& l, Real m) {
  using std::pow;
  const Real cos_alpha = glm::dot(r, v);
  return cos_alpha > resolution<Real>() ? pow(cos_alpha, m) : Real(0);
}

/// Slide "Ambient": Ia ka.
template <class Real>
Rgb<Real> ambient_light(const Rgb<Real>& intensity, const Rgb<Real>& ka) {
  return intensity * ka;
}

/// Slide "Vollstaendiges Modell", one light: Ip delta (kd (l.n) + ks (r.v)^m) per colour channel.
template <class Real>
Rgb<Real> reflected_intensity(const Rgb<Real>& intensity, const Rgb<Real>& delta, const Rgb<Real>& kd,
                              Real diffuse_factor, const Rgb<Real>& ks, Real specular_factor) {
  return intensity * delta * (kd * diffuse_factor + ks * specular_factor);
}

/// Slide "Vollstaendiges Modell": the sum over all lights, begun with Ia ka; a hidden light adds 0, and takes
/// nothing from those after it.
template <class Real>
Rgb<Real> with_light(const Rgb<Real>& so_far, [[maybe_unused]] const Rgb<Real>& ambient,
                     const Rgb<Real>& light, [[maybe_unused]] bool one_was_hidden) {
  return so_far + light;
}

/// No slide, a decision: where a mirrored or refracted ray starts. It is the point itself, because the ray
/// knows the surface that it leaves.
template <class Real>
Vec3<Real> secondary_origin(const Vec3<Real>& point, [[maybe_unused]] const Vec3<Real>& n,
                            [[maybe_unused]] const Vec3<Real>& direction) {
  return point;
}

/// The way from a lit point to a light.
template <class Real>
struct ShadowRay {
  Ray<Real> ray;  ///< of unit direction
  Real light_distance;
  bool knows_its_surface;  ///< so that the ray does not meet the surface that it starts on
};

/// Slide "Schatten": the ray from the point itself along l. Decision: it needs no offset, because it knows
/// the surface that it leaves.
template <class Real>
ShadowRay<Real> shadow_ray(const Vec3<Real>& point, [[maybe_unused]] const Vec3<Real>& n,
                           const Toward<Real>& to_light, [[maybe_unused]] const Vec3<Real>& light) {
  return {{point, to_light.direction}, to_light.distance, true};
}

/// The numbers in the world of the objects that matter when one may block a light.
struct Blocking {
  std::uint64_t candidate;
  std::uint64_t lit;    ///< the object that is to be lit
  std::uint64_t last;   ///< the largest number of all
  std::uint64_t light;  ///< the number of the light
};

/// Slide "Schatten": ANY object may block the light, the lit one too.
constexpr bool may_block([[maybe_unused]] const Blocking& objects) { return true; }

/// Slide "Schatten": an object at t blocks the light when it lies strictly between the point (t = 0)
/// and the light (t = light_distance).
template <class Real>
bool blocks_light(Real t, Real light_distance) {
  return t > 0 && t < light_distance;
}

}  // namespace plumb::formulas
