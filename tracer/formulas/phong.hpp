// Slides "Lambert", "Ambient", "Phong", "Vollstaendiges Modell" and "Schatten". All vectors unit.
#pragma once

#include <cmath>

#include "tracer/formulas/real.hpp"

namespace plumb::formulas {

/// Decision: n faces the viewer, flipped when n.d > 0 (d: direction of the ray that sees it).
template <class Real>
Vec3<Real> facing_normal(const Vec3<Real>& normal, const Vec3<Real>& direction) {
  return glm::dot(normal, direction) > 0 ? -normal : normal;
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

/// Slide "Lambert": l, normalised, from the point toward the light.
template <class Real>
Toward<Real> toward_light(const Vec3<Real>& point, const Vec3<Real>& light) {
  const Vec3<Real> offset = light - point;
  const Real distance = glm::length(offset);
  return {offset / distance, distance};
}

/// Decision: a light counts, diffuse and specular, only when n.l > 0.
template <class Real>
bool light_counts(Real diffuse_factor) {
  return diffuse_factor > 0;
}

/// Slide "Phong": r = 2 (n.l) n - l, the direction in which the surface mirrors the light.
template <class Real>
Vec3<Real> reflected_light(const Vec3<Real>& n, const Vec3<Real>& l) {
  return 2 * glm::dot(n, l) * n - l;
}

/// Slide "Phong": (r.v)^m, and 0 when r.v <= 0.
template <class Real>
Real specular_factor(const Vec3<Real>& r, const Vec3<Real>& v, Real m) {
  using std::pow;
  const Real cos_alpha = glm::dot(r, v);
  return cos_alpha > 0 ? pow(cos_alpha, m) : Real(0);
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

/// Slide "Schatten": an object at t blocks the light when it lies strictly between the point (t = 0)
/// and the light (t = light_distance).
template <class Real>
bool blocks_light(Real t, Real light_distance) {
  return t > 0 && t < light_distance;
}

}  // namespace plumb::formulas
