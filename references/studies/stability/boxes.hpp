// The conditions under which rays meet boxes.
#pragma once

#include "references/studies/stability/trial.hpp"
#include "tracer/formulas/box.hpp"

namespace plumb::studies::stability {

template <class Real>
struct BoxCase {
  Ray<Real> ray;
  Corners<Real> box;
};

/// A plate, 1/v as thick as it is wide, seen from anywhere. Every second ray aims at its rim, and half of
/// these look along it.
template <class Real>
BoxCase<Real> thin_box(double v, Random& random) {
  const Vec3<double> half(1, 1, 1 / v);
  Vec3<double> eye = 4.0 * unit_vector(random);
  Vec3<double> aim;
  for (int i = 0; i < 3; ++i) aim[i] = 0.95 * half[i] * (2 * uniform(random) - 1);
  const double kind = uniform(random);
  if (kind < 0.5) {
    const double side = eye.x < 0 ? -1 : 1;
    eye.x = side * (1.5 + std::abs(eye.x));
    if (kind < 0.25) eye.z = 0.95 * half.z * (2 * uniform(random) - 1);
    aim.x = side;
  }
  return {{Vec3<Real>(eye), glm::normalize(Vec3<Real>(aim - eye))}, {Vec3<Real>(-half), Vec3<Real>(half)}};
}

/// A cube, seen from anywhere. Rays aim at a point 1/v inside an edge; those that rounding turned into misses
/// have no true hit and do not count.
template <class Real>
BoxCase<Real> box_edge(double v, Random& random) {
  const Vec3<double> eye = 4.0 * unit_vector(random);
  Vec3<double> aim(1 - 1 / v, 1 - 1 / v, 2 * uniform(random) - 1);
  for (int i = 0; i < 2; ++i) aim[i] *= uniform(random) < 0.5 ? -1 : 1;
  return {{Vec3<Real>(eye), glm::normalize(Vec3<Real>(aim - eye))}, {Vec3<Real>(-1), Vec3<Real>(1)}};
}

/// A ray along an axis, tilted by 1/v. Every fourth is tilted by 0, every fourth by -0; every second lies in
/// the plane of a face.
template <class Real>
BoxCase<Real> near_parallel(double v, Random& random) {
  const double kind = uniform(random);
  const double tilt = kind < 0.25 ? 0.0 : kind < 0.5 ? -0.0 : 1 / v;
  const double y = uniform(random) < 0.5 ? (uniform(random) < 0.5 ? -1.0 : 1.0) : 2 * uniform(random) - 1;
  const double z = 0.5 * uniform(random);
  const int along = static_cast<int>(3 * uniform(random)) % 3;
  const int across = (along + 1) % 3, third = (along + 2) % 3;
  BoxCase<Real> c{{}, {Vec3<Real>(-1), Vec3<Real>(1)}};
  c.ray.origin[along] = -3;
  c.ray.origin[across] = static_cast<Real>(y);
  c.ray.origin[third] = static_cast<Real>(z);
  c.ray.direction[along] = 1;
  c.ray.direction[across] = static_cast<Real>(y > 0 ? -tilt : tilt);
  c.ray.direction[third] = kind < 0.5 ? static_cast<Real>(-tilt) : Real(0);
  return c;
}

template <class Real>
using BoxAt = BoxCase<Real> (*)(double value, Random&);
template <class Real>
using IntersectBox = decltype(&formulas::intersect_box<Real>);

/// A ray that comes from outside.
template <class Real>
Experiment box_trial(IntersectBox<Real> intersect, BoxAt<Real> setting) {
  return [=](double value, Random& random) {
    const BoxCase<Real> c = setting(value, random);
    const auto hit = intersect(c.ray, c.box, no_face);
    return judged(hit ? std::optional<Real>(hit->t) : std::nullopt,
                  true_box_hit(c.ray, c.box.min, c.box.max));
  };
}

}  // namespace plumb::studies::stability
