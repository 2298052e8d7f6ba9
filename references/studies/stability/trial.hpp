// One ray of a sweep: a method traces it in one real type, and 113 bits judge it.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>

#include "tracer/formulas/quad.hpp"
#include "tracer/formulas/ray.hpp"

namespace plumb::studies::stability {

using Random = std::mt19937_64;

/// What became of one ray. An error is infinite where no number came out.
struct Trial {
  bool counts = true;  ///< false: the rounding of the inputs left no question to ask
  bool missed = false;
  bool self_shadow = false;
  double ulps = 0;      ///< error of t in units in the last place of the real type; else 0
  double relative = 0;  ///< error as a share of t, of the bend or of the unit
};

/// Traces one ray of the condition at that value.
using Experiment = std::function<Trial(double value, Random&)>;

/// What a probe counts, and of what its error is one.
enum class Measure { t, direction, point, pixels };

/// What became of many rays, or of all pixels of a picture, at one value: the worst of each.
struct Outcome {
  bool counts = false;  ///< true if there was any question to ask
  bool missed = false;
  bool self_shadow = false;
  double ulps = 0;
  double relative = 0;
  double wrong = 0;  ///< share of those that count: rays missed, self-shadowed or 1 % off; wrong pixels
};

/// Runs `size` rays, or a picture of `size` rows, at this value. Several threads may call it. Throws
/// Unavailable.
using Probe = std::function<Outcome(double value, int size)>;

/// Thrown when another renderer is not on this machine. The message says which, and how to get it.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline double uniform(Random& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

inline Vec3<double> unit_vector(Random& random) {
  const double z = 2 * uniform(random) - 1;
  const double phi = 2 * std::numbers::pi * uniform(random);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

template <class Real>
Trial judged(const std::optional<Real>& t, const std::optional<Quad>& truth) {
  Trial trial;
  trial.counts = truth.has_value();
  trial.missed = !t;
  if (!truth || !t) return trial;
  const double error = static_cast<double>(abs(Quad(*t) - *truth) / *truth);
  trial.relative = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
  const double size = std::abs(static_cast<double>(*truth));
  const double ulp =
      std::ldexp(1.0, std::ilogb(size)) * static_cast<double>(std::numeric_limits<Real>::epsilon());
  trial.ulps = trial.relative * size / ulp;
  return trial;
}

/// Returns the first t > 0 on a sphere, by the foot of the perpendicular from its centre. It shares nothing
/// with the methods that it judges.
template <class Real>
std::optional<Quad> true_sphere_hit(const Ray<Real>& ray, const Vec3<Real>& center, Real radius) {
  const Vec3<Quad> d(ray.direction);
  const Vec3<Quad> to_center = Vec3<Quad>(center) - Vec3<Quad>(ray.origin);
  const Quad d_d = d.x * d.x + d.y * d.y + d.z * d.z;
  const Quad foot = (d.x * to_center.x + d.y * to_center.y + d.z * to_center.z) / d_d;
  const Vec3<Quad> gap = to_center - foot * d;
  const Quad room = Quad(radius) * Quad(radius) - gap.x * gap.x - gap.y * gap.y - gap.z * gap.z;
  if (room < 0) return std::nullopt;
  const Quad half = sqrt(room / d_d);
  // For a ray that starts on the sphere, one of both is 0 but for the rounding of their sum: 113 bits of it.
  const Quad zero = Quad(0x1p-100) * (abs(foot) + half);
  if (foot - half > zero) return foot - half;
  return foot + half > zero ? std::optional<Quad>(foot + half) : std::nullopt;
}

/// Returns the first t > 0 on a box, from where the ray enters and leaves the space between each two planes.
template <class Real>
std::optional<Quad> true_box_hit(const Ray<Real>& ray, const Vec3<Real>& low, const Vec3<Real>& high) {
  std::optional<Quad> enter, leave;
  for (int axis = 0; axis < 3; ++axis) {
    const Quad o(ray.origin[axis]), d(ray.direction[axis]);
    if (d == 0 && (o < Quad(low[axis]) || o > Quad(high[axis]))) return std::nullopt;
    if (d == 0) continue;
    const Quad first = ((d > 0 ? Quad(low[axis]) : Quad(high[axis])) - o) / d;
    const Quad last = ((d > 0 ? Quad(high[axis]) : Quad(low[axis])) - o) / d;
    if (!enter || first > *enter) enter = first;
    if (!leave || last < *leave) leave = last;
  }
  if (!enter || *enter > *leave || *leave <= 0) return std::nullopt;
  return *enter > 0 ? enter : leave;
}

}  // namespace plumb::studies::stability
