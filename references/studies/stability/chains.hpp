// The conditions of matrices, of refraction and of long paths.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "references/studies/stability/spheres.hpp"
#include "tracer/formulas/secondary.hpp"
#include "tracer/methods/transform.hpp"

namespace plumb::studies::stability {

using Steps = std::vector<TransformStep>;

/// Turned, pressed to 1/v, turned again. The matrix has the condition number v.
inline Steps pressed(double v) {
  return {Rotate{30, {1, 2, 3}}, Scale{{1, 1, 1 / v}}, Rotate{50, {3, -1, 1}}};
}
inline Steps flattened(double v) { return {Scale{{1, 1 / v, 1}}}; }
/// v steps that rotate, scale and translate in turn.
inline Steps nested(double v) {
  Random random(7);
  Steps steps;
  for (int i = 0; i < static_cast<int>(v); ++i) {
    if (i % 3 == 0)
      steps.push_back(Rotate{360 * uniform(random), unit_vector(random)});
    else if (i % 3 == 1)
      steps.push_back(Scale{Vec3<double>(i % 2 == 0 ? 2 : 0.5)});
    else
      steps.push_back(Translate{unit_vector(random)});
  }
  return steps;
}

template <class Real>
struct Placed {
  Transform<Real> here;
  Transform<Quad> exact;
  double size;  ///< length of its longest axis
};

inline double longest_axis(const Mat4<Quad>& matrix) {
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, static_cast<double>(glm::length(Vec3<Quad>(matrix[axis]))));
  return longest;
}

/// Places what has been placed at that value before only once: chains are long.
template <class Real>
class Places {
 public:
  using Place = Transform<Real> (*)(const Steps&);
  using StepsAt = Steps (*)(double value);

  Places(Place place, StepsAt steps) : place_(place), steps_(steps) {}

  /// May be called from several threads.
  const Placed<Real>& at(double value) {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(value);
    if (found != known_.end()) return found->second;
    const Steps all = steps_(value);
    const Transform<Quad> exact = transform_of<Quad>(all);
    return known_[value] = {place_(all), exact, longest_axis(exact.matrix)};
  }

 private:
  Place place_;
  StepsAt steps_;
  std::mutex mutex_;
  std::map<double, Placed<Real>> known_;
};

template <class Real>
std::optional<Real> in_object_space(const Placed<Real>& placed, const Ray<Real>& ray) {
  return formulas::intersect_sphere(formulas::transform_ray(placed.here.inverse, ray), Vec3<Real>(0), Real(1),
                                    false);
}

template <class Real>
std::optional<Real> with_unit_direction(const Placed<Real>& placed, const Ray<Real>& ray) {
  const auto in_object = methods::transform_and_normalise(placed.here.inverse, ray);
  auto t = formulas::intersect_sphere(in_object.ray, Vec3<Real>(0), Real(1), false);
  if (t) *t /= in_object.length;
  return t;
}

/// Returns the cosine at which a ray meets the moved unit sphere at t, all in 113 bits.
inline double incidence(const Transform<Quad>& exact, const Ray<Quad>& world, const Ray<Quad>& in_object,
                        Quad t) {
  const Vec3<Quad> n =
      glm::normalize(formulas::transform_normal(exact.inverse, formulas::point_at(in_object, t)));
  return std::abs(static_cast<double>(glm::dot(n, glm::normalize(world.direction))));
}

template <class Real>
using IntersectPlaced = std::optional<Real> (*)(const Placed<Real>&, const Ray<Real>&);

/// A ray toward a unit sphere that the matrix has moved, from beyond it; t counts in the world. Rays that
/// graze do not count: that is a condition of its own, and rounding a rotation alone moves their hits.
template <class Real>
Trial placed_trial(const Placed<Real>& m, IntersectPlaced<Real> intersect, Random& random) {
  constexpr double clear = 0.3;
  const Vec3<Quad> on_it = formulas::transform_point(m.exact.matrix, Vec3<Quad>(0.9 * unit_vector(random)));
  const Vec3<Quad> eye = on_it + Vec3<Quad>(3 * m.size * unit_vector(random));
  const Ray<Real> ray{Vec3<Real>(eye), glm::normalize(Vec3<Real>(on_it - eye))};
  const Ray<Quad> world{Vec3<Quad>(ray.origin), Vec3<Quad>(ray.direction)};
  const Ray<Quad> exact = formulas::transform_ray(m.exact.inverse, world);
  const auto truth = true_sphere_hit<Quad>(exact, Vec3<Quad>(0), Quad(1));
  Trial trial = judged(intersect(m, ray), truth);
  trial.counts = trial.counts && incidence(m.exact, world, exact, *truth) > clear;
  return trial;
}

template <class Real>
Experiment placed_trial(typename Places<Real>::Place place, typename Places<Real>::StepsAt steps,
                        IntersectPlaced<Real> intersect) {
  const auto places = std::make_shared<Places<Real>>(place, steps);
  return [=](double value, Random& random) { return placed_trial(places->at(value), intersect, random); };
}

/// How far a refracted direction is off, as a share of the bend; lost when only one of both is reflected.
template <class Real>
Trial refraction(const Vec3<Real>& d, const Vec3<Real>& n, Real ratio, double unit) {
  const Vec3<Quad> exact_n = glm::normalize(Vec3<Quad>(n));
  const auto truth = formulas::refracted_direction(glm::normalize(Vec3<Quad>(d)), exact_n, Quad(ratio));
  const auto found = formulas::refracted_direction(d, n, ratio);
  Trial trial;
  trial.counts = truth.has_value();
  trial.missed = !found;
  if (!truth || !found) return trial;
  trial.relative = static_cast<double>(glm::length(Vec3<Quad>(*found) - *truth)) / unit;
  return trial;
}

/// A refractive index of 1 + 1/v: the bend is about 1/v.
template <class Real>
Trial index_near_one(double v, Random& random) {
  const Vec3<Real> n = glm::normalize(Vec3<Real>(unit_vector(random)));
  Vec3<Real> d = glm::normalize(Vec3<Real>(unit_vector(random)));
  if (glm::dot(d, n) > 0) d = -d;
  return refraction(d, n, Real(1) / static_cast<Real>(1 + 1 / v), 1 / v);
}

/// Glass of 1.5 from inside, 1/v radians below the critical angle.
template <class Real>
Trial near_critical(double v, Random& random) {
  const Vec3<double> n = unit_vector(random);
  const Vec3<double> along = glm::normalize(glm::cross(n, unit_vector(random)));
  const double angle = std::asin(1 / 1.5) - std::min(0.7, 1 / v);
  const Vec3<double> d = -std::cos(angle) * n + std::sin(angle) * along;
  return refraction(glm::normalize(Vec3<Real>(d)), glm::normalize(Vec3<Real>(n)), Real(1.5), 1);
}

/// Returns where a ray within a mirrored unit sphere is after `depth` reflections.
template <class Real, bool renormalises>
Vec3<Real> after_reflections(Ray<Real> ray, int depth) {
  for (int i = 0; i < depth; ++i) {
    const auto t = formulas::intersect_sphere(ray, Vec3<Real>(0), Real(1), i > 0);
    if (!t) return Vec3<Real>(std::numeric_limits<Real>::quiet_NaN());
    const Vec3<Real> p = formulas::point_at(ray, *t);
    ray = {p, formulas::mirror_direction(ray.direction, renormalises ? glm::normalize(p) : p)};
  }
  return ray.origin;
}

template <class Real, bool renormalises>
Trial reflections(double depth, Random& random) {
  const Vec3<Real> origin(0.5 * unit_vector(random));
  const Vec3<Real> direction = glm::normalize(Vec3<Real>(unit_vector(random)));
  const int count = static_cast<int>(depth);
  const Vec3<Real> found = after_reflections<Real, renormalises>({origin, direction}, count);
  const Vec3<Quad> truth = after_reflections<Quad, true>({Vec3<Quad>(origin), Vec3<Quad>(direction)}, count);
  Trial trial;
  trial.missed = !(found.x == found.x);
  trial.relative = trial.missed ? 0 : static_cast<double>(glm::length(Vec3<Quad>(found) - truth));
  return trial;
}

}  // namespace plumb::studies::stability
