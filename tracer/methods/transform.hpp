// Other ways to place shapes and to treat their normals and rays.
#pragma once

#include <cmath>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb::methods {

/// An entry for transform_of, as general-purpose libraries do it: multiplies the matrices and inverts the
/// product by cofactors.
template <class Real>
Transform<Real> inverse_of_product(const std::vector<TransformStep>& steps) {
  Transform<Real> all = transform_of<Real>(steps);
  all.inverse = glm::inverse(all.matrix);
  return all;
}

/// An entry for formulas::unit_normal that does not normalise, as if a scale did not matter.
template <class Real>
Vec3<Real> normal_as_it_is(const Vec3<Real>& n) {
  return n;
}

/// A ray in an object's space with a unit direction. `length` is that of the direction before, so that t /
/// length counts in the world's lengths.
template <class Real>
struct UnitRay {
  Ray<Real> ray;
  Real length;
};

/// Normalises the direction in object space. t then has to be divided by the length, which is easy to forget.
template <class Real>
UnitRay<Real> transform_and_normalise(const Mat4<Real>& m, const Ray<Real>& ray) {
  const Ray<Real> in_object = formulas::transform_ray(m, ray);
  const Real length = glm::length(in_object.direction);
  return {{in_object.origin, in_object.direction / length}, length};
}

}  // namespace plumb::methods
