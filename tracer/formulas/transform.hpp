// Slides "Transformationen", "Zusammengesetzt, Inverse" and "Anwendung".
#pragma once

#include <cmath>

#include "tracer/formulas/camera.hpp"
#include "tracer/formulas/ray.hpp"

namespace plumb {

/// An affine map and its inverse, kept as a pair so that no matrix is ever inverted numerically.
template <class Real>
struct Transform {
  Mat4<Real> matrix{1};
  Mat4<Real> inverse{1};
};

namespace formulas {

template <class Real>
Mat4<Real> translation_matrix(const Vec3<Real>& by) {
  Mat4<Real> matrix(1);
  matrix[3] = {by, 1};
  return matrix;
}

template <class Real>
Mat4<Real> scale_matrix(const Vec3<Real>& by) {
  Mat4<Real> matrix(1);
  for (int i = 0; i < 3; ++i) matrix[i][i] = by[i];
  return matrix;
}

/// Slide "Transformationen": turns counter-clockwise about an axis through the origin, as seen from the axis'
/// positive end. Rodrigues, "Des lois geometriques ...", J. Math. Pures Appl. 5 (1840): R = cos a I + (1 -
/// cos a) k k^T + sin a [k]x. The axis may have any length but 0.
template <class Real>
Mat4<Real> rotation_matrix(Real degrees, const Vec3<Real>& axis) {
  using std::cos;
  using std::sin;
  const Vec3<Real> k = glm::normalize(axis);
  const Real c = cos(radians(degrees));
  const Real s = sin(radians(degrees));
  const Vec3<Real> q = (1 - c) * k;
  Mat4<Real> matrix(1);
  matrix[0] = {q.x * k.x + c, q.x * k.y + s * k.z, q.x * k.z - s * k.y, 0};
  matrix[1] = {q.y * k.x - s * k.z, q.y * k.y + c, q.y * k.z + s * k.x, 0};
  matrix[2] = {q.z * k.x + s * k.y, q.z * k.y - s * k.x, q.z * k.z + c, 0};
  return matrix;
}

/// Slide "Transformationen": T(v); its inverse is T(-v).
template <class Real>
Transform<Real> translate(const Vec3<Real>& by) {
  return {translation_matrix(by), translation_matrix(-by)};
}

/// Slide "Transformationen": S(v); its inverse is S(1/v). No component may be 0.
template <class Real>
Transform<Real> scale(const Vec3<Real>& by) {
  return {scale_matrix(by), scale_matrix(Real(1) / by)};
}

/// Slide "Transformationen": R(angle, axis); its inverse is its transpose.
template <class Real>
Transform<Real> rotate(Real degrees, const Vec3<Real>& axis) {
  const Mat4<Real> matrix = rotation_matrix(degrees, axis);
  return {matrix, glm::transpose(matrix)};
}

/// Slide "Zusammengesetzt, Inverse": `then` after `first`, M = M2 M1, M^-1 = M1^-1 M2^-1. Scale, rotate and
/// translate in this order give the lecture's M = T R S.
template <class Real>
Transform<Real> compose(const Transform<Real>& then, const Transform<Real>& first) {
  return {then.matrix * first.matrix, first.inverse * then.inverse};
}

/// Slide "Anwendung": M p with w = 1.
template <class Real>
Vec3<Real> transform_point(const Mat4<Real>& m, const Vec3<Real>& p) {
  return Vec3<Real>(m[0]) * p.x + Vec3<Real>(m[1]) * p.y + Vec3<Real>(m[2]) * p.z + Vec3<Real>(m[3]);
}

/// Slide "Anwendung": M v with w = 0, so that a translation does not move it.
template <class Real>
Vec3<Real> transform_vector(const Mat4<Real>& m, const Vec3<Real>& v) {
  return Vec3<Real>(m[0]) * v.x + Vec3<Real>(m[1]) * v.y + Vec3<Real>(m[2]) * v.z;
}

/// Slide "Anwendung": (M^-1)^T n with w = 0, computed from M^-1. The result is not normalised.
template <class Real>
Vec3<Real> transform_normal(const Mat4<Real>& inverse, const Vec3<Real>& n) {
  return {glm::dot(Vec3<Real>(inverse[0]), n), glm::dot(Vec3<Real>(inverse[1]), n),
          glm::dot(Vec3<Real>(inverse[2]), n)};
}

/// Slide "Anwendung": transforms the origin as a point and the direction as a vector. The direction is not
/// normalised, so t means the same point on both sides (slide "Objekttransformation").
template <class Real>
Ray<Real> transform_ray(const Mat4<Real>& m, const Ray<Real>& ray) {
  return {transform_point(m, ray.origin), transform_vector(m, ray.direction)};
}

/// No slide: |M| v. It bounds, along each axis, what M makes of vectors whose components are at most v. For a
/// rotation the bound is at most sqrt(3) too large.
template <class Real>
Vec3<Real> absolute_product(const Mat4<Real>& m, const Vec3<Real>& v) {
  return glm::abs(Vec3<Real>(m[0])) * v.x + glm::abs(Vec3<Real>(m[1])) * v.y +
         glm::abs(Vec3<Real>(m[2])) * v.z;
}

/// Slide "Kameratransformation": C times a ray of camera space. The world ray has a unit direction.
template <class Real>
Ray<Real> world_ray(const Mat4<Real>& camera_matrix, const Ray<Real>& in_camera) {
  const Ray<Real> ray = transform_ray(camera_matrix, in_camera);
  return {ray.origin, glm::normalize(ray.direction)};
}

/// A hit as it is seen on both sides of a node's matrix.
template <class Real>
struct HitInTwoSpaces {
  const Transform<Real>& parent_from_object;
  const Ray<Real>& parent_ray;
  Real t;
  Vec3<Real> object_point;
  bool is_composite;  ///< true when the matrix places an inner node, false for a sphere or a box
};

/// Slide "Objekttransformation": t is valid in both spaces, so the hit in the parent's space is p0 + t d
/// there.
template <class Real>
Vec3<Real> point_in_parent(const HitInTwoSpaces<Real>& hit) {
  return point_at(hit.parent_ray, hit.t);
}

/// Slide "Anwendung": a normal is normalised again once it has been transformed.
template <class Real>
Vec3<Real> unit_normal(const Vec3<Real>& n) {
  return glm::normalize(n);
}

}  // namespace formulas
}  // namespace plumb
