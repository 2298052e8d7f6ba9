// Slide "Quader": where a ray meets an axis-parallel box.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tracer/formulas/ray.hpp"

namespace plumb {

/// The number of a box's face: 2 * axis for the face at p_min, 2 * axis + 1 for the face at p_max.
using Face = int;
inline constexpr Face no_face = -1;

template <class Real>
struct FaceHit {
  Real t;
  Face face;
};

template <class Real>
struct Corners {
  Vec3<Real> min;
  Vec3<Real> max;
};

namespace formulas {

/// Slide "Quader": the box from its centre and edge lengths.
template <class Real>
Corners<Real> box_from_center(const Vec3<Real>& center, const Vec3<Real>& edges) {
  return {center - edges / Real(2), center + edges / Real(2)};
}

/// No slide, a decision: true if the ray runs along the planes of this axis. A component of the direction
/// that a few roundings may have made counts as 0.
template <class Real>
bool is_parallel(const Ray<Real>& ray, int axis) {
  using std::abs;
  return abs(ray.direction[axis]) <= 16 * std::numeric_limits<Real>::epsilon() * ray.world_length[axis];
}

/// No slide, a decision: the t at which a ray crosses the plane of an axis. Where the ray grazes the plane, a
/// few roundings of a place move t far. There a plane through the ray's origin is crossed at 0, and a plane
/// through what the ray is known to meet is crossed at t_known.
template <class Real>
Real plane_crossed_at(const Ray<Real>& ray, int axis, Real plane) {
  using std::abs;
  const Real o = ray.origin[axis];
  const Real d = ray.direction[axis];
  const Real t = (plane - o) * (1 / d);
  const Real few_roundings = grazing_slope<Real>() * ray.world_length[axis];
  if (abs(d) > few_roundings) return t;
  if (abs(plane - o) <= one_place(ray, Real(0)) * few_roundings) return 0;
  if (abs(plane - (o + ray.t_known * d)) < one_place(ray, ray.t_known) * few_roundings) return ray.t_known;
  return t;
}

/// No slide, a decision: the face that a ray meets at t. Where planes of several axes are met at one place,
/// the first axis counts. `times` are the t of the three planes that are entered or, if not `is_entered`,
/// left.
template <class Real>
Face face_met_at(Real t, const Vec3<Real>& times, const Ray<Real>& ray, bool is_entered) {
  using std::abs;
  int axis = 0;
  while (axis < 2 && !(abs(times[axis] - t) <= one_place(ray, t))) ++axis;
  const bool is_low = (ray.direction[axis] > 0) == is_entered;
  return 2 * axis + (is_low ? 0 : 1);
}

/// Slide "Quader": the first hit of a ray on a box, or no value for a miss. The ray enters only by the three
/// planes toward the viewer. It is inside after the last of them and before the first of the other three.
/// From inside, the hit is where the ray leaves. A ray that starts on `start_face` leaves that plane for good
/// and never meets it again, so no epsilon is needed.
template <class Real>
std::optional<FaceHit<Real>> intersect_box(const Ray<Real>& ray, const Corners<Real>& box, Face start_face) {
  Vec3<Real> enter(-std::numeric_limits<Real>::infinity());
  Vec3<Real> leave(std::numeric_limits<Real>::infinity());
  for (int axis = 0; axis < 3; ++axis) {
    if (is_parallel(ray, axis)) {
      if (start_face != no_face && start_face / 2 == axis) return std::nullopt;  // runs along it
      const Real o = ray.origin[axis];
      const Real beside = ray.t_min * ray.world_length[axis];
      if (o < box.min[axis] - beside || o > box.max[axis] + beside) return std::nullopt;
      continue;
    }
    const bool ascending = ray.direction[axis] > 0;
    const Face near_face = 2 * axis + (ascending ? 0 : 1);
    const Face far_face = 2 * axis + (ascending ? 1 : 0);
    if (start_face == far_face) return std::nullopt;  // starts there and moves away
    const Real near_plane = ascending ? box.min[axis] : box.max[axis];
    const Real far_plane = ascending ? box.max[axis] : box.min[axis];
    enter[axis] = start_face == near_face ? Real(0) : plane_crossed_at(ray, axis, near_plane);
    leave[axis] = plane_crossed_at(ray, axis, far_plane);
  }
  const Real inside_from = std::max({enter.x, enter.y, enter.z});
  const Real inside_to = std::min({leave.x, leave.y, leave.z});
  if (!(inside_from <= inside_to + one_place(ray, inside_to))) return std::nullopt;
  if (inside_from > ray.t_min && start_face == no_face)
    return FaceHit<Real>{inside_from, face_met_at(inside_from, enter, ray, true)};
  if (inside_to > ray.t_min && inside_to < std::numeric_limits<Real>::infinity())
    return FaceHit<Real>{inside_to, face_met_at(inside_to, leave, ray, false)};
  return std::nullopt;
}

/// Outward unit normal of a face, in the box's space.
template <class Real>
Vec3<Real> box_normal(Face face) {
  Vec3<Real> normal(0);
  normal[face / 2] = face % 2 == 0 ? Real(-1) : Real(1);
  return normal;
}

}  // namespace formulas
}  // namespace plumb
