// Ways to intersect an axis-parallel box, each as an entry for formulas::intersect_box.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "tracer/formulas/box.hpp"

namespace plumb::methods {

/// True if the ray moves away from the face that it starts on.
template <class Real>
bool moves_away(const Ray<Real>& ray, Face start) {
  if (start == no_face) return false;
  const Real d = ray.direction[start / 2];
  return start % 2 == 0 ? d <= 0 : d >= 0;
}

/// Returns t where the ray meets the plane of a face, if that point lies within the face's rectangle.
template <class Real>
std::optional<Real> plane_hit(const Ray<Real>& ray, const Corners<Real>& box, Face face) {
  const int axis = face / 2;
  if (ray.direction[axis] == 0) return std::nullopt;
  const Real plane = face % 2 == 0 ? box.min[axis] : box.max[axis];
  const Real t = (plane - ray.origin[axis]) / ray.direction[axis];
  if (!(t > 0)) return std::nullopt;
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
    const Real p = ray.origin[other] + t * ray.direction[other];
    if (!(p >= box.min[other] && p <= box.max[other])) return std::nullopt;
  }
  return t;
}

/// Returns the nearest plane_hit of the faces that `takes` accepts.
template <class Real, class Takes>
std::optional<FaceHit<Real>> nearest_plane(const Ray<Real>& ray, const Corners<Real>& box, Takes takes) {
  std::optional<FaceHit<Real>> nearest;
  for (Face face = 0; face < 6; ++face) {
    if (!takes(face)) continue;
    const auto t = plane_hit(ray, box, face);
    if (t && (!nearest || *t < nearest->t)) nearest = FaceHit<Real>{*t, face};
  }
  return nearest;
}

/// Slide "Quader" to the letter: tests all six planes, and each point against the face's rectangle.
template <class Real>
std::optional<FaceHit<Real>> box_six_planes(const Ray<Real>& ray, const Corners<Real>& box, Face start) {
  if (moves_away(ray, start)) return std::nullopt;
  return nearest_plane(ray, box, [start](Face face) { return face != start; });
}

/// Slide "Quader": tests only the planes that face the viewer, and from inside all others (Woo, "Fast Ray-Box
/// Intersection", Graphics Gems, 1990).
template <class Real>
std::optional<FaceHit<Real>> box_front_faces(const Ray<Real>& ray, const Corners<Real>& box, Face start) {
  if (moves_away(ray, start)) return std::nullopt;
  const auto faces_viewer = [&](Face face) { return (face % 2 == 0) == (ray.direction[face / 2] > 0); };
  if (start == no_face) {
    if (const auto hit = nearest_plane(ray, box, faces_viewer)) return hit;
  }
  return nearest_plane(ray, box, [&](Face face) { return face != start && !faces_viewer(face); });
}

/// The part of a ray that lies within all slabs so far.
template <class Real>
struct Span {
  FaceHit<Real> enter{-std::numeric_limits<Real>::infinity(), no_face};
  FaceHit<Real> leave{std::numeric_limits<Real>::infinity(), no_face};

  void cut(int axis, Real near_t, Real far_t, bool ascends) {
    if (near_t > enter.t) enter = {near_t, 2 * axis + (ascends ? 0 : 1)};
    if (far_t < leave.t) leave = {far_t, 2 * axis + (ascends ? 1 : 0)};
  }
  std::optional<FaceHit<Real>> first_hit(Face start, Real padding = 1) const {
    if (!(enter.t <= leave.t * padding)) return std::nullopt;
    if (enter.t > 0 && start == no_face) return enter;
    return leave.t > 0 && leave.face != no_face ? std::optional(leave) : std::nullopt;
  }
};

/// Slabs (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986): two divisions per axis, sorted.
template <class Real>
std::optional<FaceHit<Real>> box_kay_kajiya(const Ray<Real>& ray, const Corners<Real>& box, Face start) {
  if (moves_away(ray, start)) return std::nullopt;
  Span<Real> span;
  for (int axis = 0; axis < 3; ++axis) {
    const Real o = ray.origin[axis];
    const Real d = ray.direction[axis];
    if (d == 0) {
      if (o < box.min[axis] || o > box.max[axis]) return std::nullopt;
      continue;
    }
    Real near_t = (box.min[axis] - o) / d;
    Real far_t = (box.max[axis] - o) / d;
    const bool ascends = near_t <= far_t;
    if (!ascends) std::swap(near_t, far_t);
    span.cut(axis, near_t, far_t, ascends);
  }
  return span.first_hit(start);
}

template <class Real>
Span<Real> span_by_reciprocals(const Ray<Real>& ray, const Corners<Real>& box) {
  Span<Real> span;
  for (int axis = 0; axis < 3; ++axis) {
    const Real per_d = 1 / ray.direction[axis];
    const bool ascends = per_d >= 0;
    const Real near_plane = ascends ? box.min[axis] : box.max[axis];
    const Real far_plane = ascends ? box.max[axis] : box.min[axis];
    span.cut(axis, (near_plane - ray.origin[axis]) * per_d, (far_plane - ray.origin[axis]) * per_d, ascends);
  }
  return span;
}

/// Slabs by the sign of 1/d, without a case for zero (Williams, Barrus, Morley, Shirley, "An Efficient and
/// Robust Ray-Box Intersection Algorithm", JGT 10, 2005). The comparisons are theirs, so the x slab is taken
/// as it is. Where a ray across x starts on an x plane, 0 times infinity stays in the span and the box is
/// lost. In y and z every comparison ignores it.
template <class Real>
std::optional<FaceHit<Real>> box_williams(const Ray<Real>& ray, const Corners<Real>& box, Face start) {
  if (moves_away(ray, start)) return std::nullopt;
  Span<Real> span;
  for (int axis = 0; axis < 3; ++axis) {
    const Real per_d = 1 / ray.direction[axis];
    const bool ascends = per_d >= 0;
    const Real near_t = ((ascends ? box.min[axis] : box.max[axis]) - ray.origin[axis]) * per_d;
    const Real far_t = ((ascends ? box.max[axis] : box.min[axis]) - ray.origin[axis]) * per_d;
    if (span.enter.t > far_t || near_t > span.leave.t) return std::nullopt;
    if (axis == 0 || near_t > span.enter.t) span.enter = {near_t, 2 * axis + (ascends ? 0 : 1)};
    if (axis == 0 || far_t < span.leave.t) span.leave = {far_t, 2 * axis + (ascends ? 1 : 0)};
  }
  return span.first_hit(start);
}

/// Slabs whose far side is padded by 2 ulp, so that rounding loses no hit (Ize, "Robust BVH Ray Traversal",
/// JCGT 2, 2013).
template <class Real>
std::optional<FaceHit<Real>> box_ize(const Ray<Real>& ray, const Corners<Real>& box, Face start) {
  if (moves_away(ray, start)) return std::nullopt;
  return span_by_reciprocals(ray, box).first_hit(start, 1 + 2 * std::numeric_limits<Real>::epsilon());
}

/// Any of these methods, but unaware of the face that the ray starts on.
template <class Real, auto intersect>
std::optional<FaceHit<Real>> box_unaware(const Ray<Real>& ray, const Corners<Real>& box, Face) {
  return intersect({ray.origin, ray.direction}, box, no_face);
}

}  // namespace plumb::methods
