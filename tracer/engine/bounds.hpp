// Axis-parallel bounds of shapes. They are never too small.
#pragma once

#include <limits>

#include "tracer/engine/compiled_scene.hpp"

namespace plumb::engine {

struct Bounds3 {
  Vec3<double> min{std::numeric_limits<double>::infinity()};
  Vec3<double> max{-std::numeric_limits<double>::infinity()};

  void add(const Bounds3& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
};

/// Returns bounds widened by what rounding may move a hit off the surface, as a share of the largest
/// coordinate.
template <class Real>
Bounds3 padded(const Bounds3& b) {
  const Vec3<double> size = glm::max(glm::abs(b.min), glm::abs(b.max));
  const Vec3<double> pad(16 * static_cast<double>(std::numeric_limits<Real>::epsilon()) *
                         glm::max(size.x, glm::max(size.y, size.z)));
  return {b.min - pad, b.max + pad};
}

template <class Real>
Bounds3 bounds_of(const Sphere<Real>& s) {
  const Vec3<double> center(s.center), radius(static_cast<double>(s.radius));
  return padded<Real>({center - radius, center + radius});
}

template <class Real>
Bounds3 bounds_of(const Box<Real>& b) {
  return padded<Real>({Vec3<double>(b.min), Vec3<double>(b.max)});
}

/// Returns the bounds of a box's image: its centre moves by M, its half edges by |M|.
inline Bounds3 transformed(const Mat4<double>& m, const Bounds3& b) {
  const Vec3<double> center = formulas::transform_point(m, (b.min + b.max) * 0.5);
  const Vec3<double> half = (b.max - b.min) * 0.5;
  const Vec3<double> reach = glm::abs(Vec3<double>(m[0])) * half.x + glm::abs(Vec3<double>(m[1])) * half.y +
                             glm::abs(Vec3<double>(m[2])) * half.z;
  return {center - reach, center + reach};
}

/// Returns the bounds of a sphere's image: along each axis it reaches as far as the row of M is long.
inline Bounds3 transformed(const Mat4<double>& m, const Sphere<double>& s) {
  const Vec3<double> center = formulas::transform_point(m, s.center);
  const Vec3<double> squares = Vec3<double>(m[0]) * Vec3<double>(m[0]) +
                               Vec3<double>(m[1]) * Vec3<double>(m[1]) +
                               Vec3<double>(m[2]) * Vec3<double>(m[2]);
  const Vec3<double> reach = glm::sqrt(squares) * s.radius;
  return {center - reach, center + reach};
}

}  // namespace plumb::engine
