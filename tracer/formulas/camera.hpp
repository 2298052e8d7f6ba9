// Slides "Kameramodell", "Rapid Prototyping" and "Kameratransformation".
#pragma once

#include <cmath>
#include <numbers>

#include "tracer/formulas/ray.hpp"

namespace plumb::formulas {

template <class Real>
Real radians(Real degrees) {
  return degrees * (std::numbers::pi_v<Real> / 180);
}

/// Slide "Kameramodell": the distance from the eye of the image plane of width 1 that fills the horizontal
/// field of view, d = (1/2) / tan(fov_x / 2). Expects 0 < fov_x_degrees < 180.
template <class Real>
Real image_plane_distance(Real fov_x_degrees) {
  using std::tan;
  return Real(0.5) / tan(radians(fov_x_degrees) / 2);
}

/// Slide "Kameramodell": the centre of pixel (x, y) on the image plane of width 1 and height height/width.
/// The plane's origin is its middle, y points upwards; row 0 is the top row.
template <class Real>
Vec2<Real> image_plane_point(int x, int y, int width, int height) {
  const Real w = static_cast<Real>(width);
  const Real h = static_cast<Real>(height);
  const Real right = (static_cast<Real>(x) + Real(0.5)) / w - Real(0.5);
  const Real up = ((h - 1) - (static_cast<Real>(y) - Real(0.5))) / h - Real(0.5);
  return {right, up * (h / w)};
}

/// Slide "Kameramodell": the ray in camera space (eye at the origin, looking along -z) through a point of the
/// image plane. Its direction is not normalised.
template <class Real>
Ray<Real> camera_ray(Vec2<Real> image_plane_point, Real image_plane_distance) {
  return {Vec3<Real>(0), {image_plane_point.x, image_plane_point.y, -image_plane_distance}};
}

/// Slide "Rapid Prototyping": a ray of the 401 x 401 grid with dx and dy from -200 to 200 in steps of 1. Its
/// direction is 401 times that of camera_ray for a 401 x 401 image.
template <class Real>
Ray<Real> prototype_ray(int dx, int dy, Real fov_x_degrees) {
  const Real distance = 401 * image_plane_distance(fov_x_degrees);
  return {Vec3<Real>(0), {static_cast<Real>(dx), static_cast<Real>(dy), -distance}};
}

/// Slide "Kameratransformation": u = n x up, v = u x n, all normalised; C = [u v -n e] takes camera
/// space to world space. Expects direction and up finite, non-zero and not parallel.
template <class Real>
Mat4<Real> camera_matrix(const Vec3<Real>& eye, const Vec3<Real>& direction, const Vec3<Real>& up) {
  const Vec3<Real> n = glm::normalize(direction);
  const Vec3<Real> u = glm::normalize(glm::cross(n, glm::normalize(up)));
  const Vec3<Real> v = glm::cross(u, n);
  using Vec4 = glm::vec<4, Real, glm::highp>;
  return {Vec4(u, 0), Vec4(v, 0), Vec4(-n, 0), Vec4(eye, 1)};
}

}  // namespace plumb::formulas
