// The conditions under which rays meet spheres and leave them.
#pragma once

#include <algorithm>

#include "references/studies/stability/trial.hpp"
#include "tracer/formulas/sphere.hpp"

namespace plumb::studies::stability {

template <class Real>
struct SphereCase {
  Ray<Real> ray;
  Vec3<Real> center;
  Real radius;
};

/// What a condition means in numbers: lengths, in double.
struct SphereSetting {
  Vec3<double> center;
  double radius;
  double distance;  ///< from the eye to the centre
  double impact;    ///< from the aim to the centre, over the radius
};

/// A clear hit: within 0.9 of the radius, spread evenly over the disc.
inline double clear_impact(Random& random) { return 0.9 * std::sqrt(uniform(random)); }

inline SphereSetting far_sphere(double v, Random& r) { return {Vec3<double>(0), 1, v + 1, clear_impact(r)}; }
inline SphereSetting small_sphere(double v, Random& r) {
  return {unit_vector(r), 1 / v, 2 + 1 / v, clear_impact(r)};
}
inline SphereSetting scaled_sphere(double v, Random& r) {
  return {v * unit_vector(r), v, 3 * v, clear_impact(r)};
}
inline SphereSetting shrunk_sphere(double v, Random& r) { return scaled_sphere(1 / v, r); }
inline SphereSetting offset_sphere(double v, Random& r) {
  return {v * unit_vector(r), 1, 3, clear_impact(r)};
}
inline SphereSetting grazed_sphere(double v, Random&) {
  return {Vec3<double>(0), 1, 3, std::sqrt(1 - 1 / (v * v))};
}

template <class Real>
SphereCase<Real> rounded(const SphereSetting& setting, Random& random) {
  const Vec3<double> away = unit_vector(random);
  const Vec3<double> across = glm::normalize(glm::cross(away, unit_vector(random)));
  const Vec3<double> aim = setting.center + setting.impact * setting.radius * across;
  const Vec3<double> eye = setting.center + setting.distance * away;
  const Vec3<Real> origin(eye);
  return {{origin, glm::normalize(Vec3<Real>(aim - eye))},
          Vec3<Real>(setting.center),
          static_cast<Real>(setting.radius)};
}

using SphereAt = SphereSetting (*)(double value, Random&);
template <class Real>
using IntersectSphere = decltype(&formulas::intersect_sphere<Real>);

/// A ray that comes from outside.
template <class Real>
Experiment sphere_trial(IntersectSphere<Real> intersect, SphereAt setting) {
  return [=](double value, Random& random) {
    const SphereCase<Real> c = rounded<Real>(setting(value, random), random);
    return judged(intersect(c.ray, c.center, c.radius, false), true_sphere_hit(c.ray, c.center, c.radius));
  };
}

/// The way in which a ray is kept off the surface that it starts on.
template <class Real>
struct Start {
  Vec3<Real> (*origin)(const Vec3<Real>&, const Vec3<Real>&, const Vec3<Real>&);
  bool (*is_ahead)(Real, Real);
  bool knows_its_surface;
  bool refines = false;  ///< true: puts the point back onto the sphere first
};

template <class Real>
Real rounding_at(const Vec3<Real>& p) {
  using std::abs;
  return formulas::resolution<Real>() * std::max({abs(p.x), abs(p.y), abs(p.z)});
}

/// A ray leaves the sphere outward, where it must meet nothing, and inward, where it must reach the far side.
template <class Real>
Trial start_trial(const Start<Real>& way, const SphereCase<Real>& c, IntersectSphere<Real> intersect,
                  Random& random) {
  const auto t = intersect(c.ray, c.center, c.radius, false);
  if (!t) return {.counts = false};
  const Vec3<Real> along = formulas::point_at(c.ray, *t);
  const Vec3<Real> n = glm::normalize(along - c.center);
  const Vec3<Real> p = way.refines ? c.center + c.radius * n : along;
  Vec3<Real> out(unit_vector(random));
  if (glm::dot(out, n) < 0) out = -out;
  const auto meets = [&](const Vec3<Real>& direction) {
    const Vec3<Real> origin = way.origin(p, n, direction);
    auto hit = intersect({origin, direction}, c.center, c.radius, way.knows_its_surface);
    if (hit && !way.is_ahead(*hit, rounding_at(origin))) hit.reset();
    return hit;
  };
  Trial trial;
  trial.self_shadow = meets(out).has_value();
  const Real chord = 2 * c.radius * glm::dot(out, n);
  const auto far_side = meets(-out);
  trial.missed = !far_side && chord > c.radius / 100;  // shorter chords are rightly lost in rounding
  return trial;
}

template <class Real>
Experiment start_trial(const Start<Real>& way, SphereAt setting,
                       IntersectSphere<Real> intersect = &formulas::intersect_sphere<Real>) {
  return [=](double value, Random& random) {
    return start_trial(way, rounded<Real>(setting(value, random), random), intersect, random);
  };
}

}  // namespace plumb::studies::stability
