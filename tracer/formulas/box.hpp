// Slide "Quader": where a ray meets an axis-parallel box.
#pragma once

#include <limits>
#include <optional>

#include "tracer/formulas/ray.hpp"

namespace plumb {

/// Face of a box: 2 * axis for the face at p_min, 2 * axis + 1 for the face at p_max.
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

/// Slide "Quader": of the six planes only the three toward the viewer can be entered, and the ray is
/// inside after the last of them and before the first of the other three; from inside, the hit is
/// where it leaves. No value for a miss. A ray that starts on `start_face` leaves that
/// plane for good, so it is never met again: no epsilon is needed.
template <class Real>
std::optional<FaceHit<Real>> intersect_box(const Ray<Real>& ray, const Corners<Real>& box, Face start_face) {
  FaceHit<Real> enter{-std::numeric_limits<Real>::infinity(), no_face};
  FaceHit<Real> leave{std::numeric_limits<Real>::infinity(), no_face};
  for (int axis = 0; axis < 3; ++axis) {
    const Real d = ray.direction[axis];
    const Real o = ray.origin[axis];
    if (d == 0) {  // parallel to both planes
      if (o < box.min[axis] || o > box.max[axis]) return std::nullopt;
      continue;
    }
    const bool ascending = d > 0;
    const Face near_face = 2 * axis + (ascending ? 0 : 1);
    const Face far_face = 2 * axis + (ascending ? 1 : 0);
    if (start_face == far_face) return std::nullopt;  // starts there and moves away
    const Real per_d = 1 / d;
    const Real near_plane = ascending ? box.min[axis] : box.max[axis];
    const Real far_plane = ascending ? box.max[axis] : box.min[axis];
    const Real t_near = start_face == near_face ? Real(0) : (near_plane - o) * per_d;
    const Real t_far = (far_plane - o) * per_d;
    if (t_near > enter.t) enter = {t_near, near_face};
    if (t_far < leave.t) leave = {t_far, far_face};
  }
  if (!(enter.t <= leave.t)) return std::nullopt;
  if (enter.t > 0 && start_face == no_face) return enter;
  if (leave.t > 0 && leave.face != no_face) return leave;
  return std::nullopt;
}

/// Outward unit normal of a face.
template <class Real>
Vec3<Real> box_normal(Face face) {
  Vec3<Real> normal(0);
  normal[face / 2] = face % 2 == 0 ? Real(-1) : Real(1);
  return normal;
}

}  // namespace formulas
}  // namespace plumb
