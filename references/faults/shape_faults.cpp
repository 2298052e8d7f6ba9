// Slides "Kugel", "Quader" and "Verfolgen von Strahlen": what is hit first.
#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

using OptionalHit = std::optional<FaceHit<double>>;

bool is_inside(const Vec3d& p, const Corners<double>& box) {
  return glm::all(glm::lessThan(box.min, p)) && glm::all(glm::lessThan(p, box.max));
}

OptionalHit missed_from_inside(const Ray<double>& ray, const Corners<double>& box, Face start) {
  if (start == no_face && is_inside(ray.origin, box)) return std::nullopt;
  return formulas::intersect_box(ray, box, start);
}

OptionalHit without_origin(const Ray<double>& ray, const Corners<double>& box, Face start) {
  return formulas::intersect_box(Ray<double>{Vec3d(0), ray.direction}, box, start);
}

/// Returns the first face, in the order x y z, whose plane holds the hit point exactly; the last one if none
/// does.
OptionalHit face_by_equality(const Ray<double>& ray, const Corners<double>& box, Face start) {
  const auto hit = formulas::intersect_box(ray, box, start);
  if (!hit) return hit;
  const Vec3d p = formulas::point_at(ray, hit->t);
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == box.min[axis]) return FaceHit<double>{hit->t, 2 * axis};
    if (p[axis] == box.max[axis]) return FaceHit<double>{hit->t, 2 * axis + 1};
  }
  return FaceHit<double>{hit->t, 5};
}

/// The face at the greatest z is no part of the box: a ray enters there and meets the next one behind it.
OptionalHit without_front_face(const Ray<double>& ray, const Corners<double>& box, Face start) {
  constexpr Face front = 5;
  const auto hit = formulas::intersect_box(ray, box, start);
  if (!hit || hit->face != front) return hit;
  const auto behind =
      formulas::intersect_box(Ray<double>{formulas::point_at(ray, hit->t), ray.direction}, box, front);
  if (!behind) return std::nullopt;
  return FaceHit<double>{hit->t + behind->t, behind->face};
}

std::optional<double> t_of_unit_direction(const Ray<double>& ray, const Vec3d& center, double radius,
                                          bool starts_on_it) {
  const auto t = formulas::intersect_sphere(ray, center, radius, starts_on_it);
  if (!t) return t;
  return *t * glm::length(ray.direction);
}

std::optional<double> nearer_root_only(const Ray<double>& ray, const Vec3d& center, double radius,
                                       bool starts_on_it) {
  const Vec3d offset = ray.origin - center;
  if (!starts_on_it && glm::dot(offset, offset) < radius * radius) return std::nullopt;
  return formulas::intersect_sphere(ray, center, radius, starts_on_it);
}

template <auto intersection>
void take_box(Subject& s) {
  s.formulas.intersect_box = intersection;
}

template <auto intersection>
void take_sphere(Subject& s) {
  s.formulas.intersect_sphere = intersection;
}

}  // namespace

std::vector<Fault> of_the_shapes() {
  return {
      {"box-missed-from-inside", 31, "Quader", "From inside a box, the root behind the ray's start is taken.",
       "t of the planes entered, < 0", "the smallest t > 0", "11 of 42", "box-inside.sdf",
       &take_box<&missed_from_inside>, nullptr},
      {"box-without-origin", 31, "Quader", "The ray's origin is forgotten in the planes' equations.",
       "t = p_min / d", "t = (p_min - p0) / d", "2 of 42", "box.sdf", &take_box<&without_origin>, nullptr},
      {"box-face-by-equality", 31, "Quader",
       "The face is found by comparing coordinates with ==, x first, so rounding decides.", "p.x == p_min.x",
       "the face whose plane gave t", "12 of 42", "box.sdf", &take_box<&face_by_equality>, nullptr},
      {"box-normals-inverted", 31, "Quader",
       "A box's normals point inwards, and nobody turns them to the viewer.", "n = -outward",
       "n toward the viewer", "1 of 42", "box.sdf",
       [](Subject& s) {
         s.formulas.box_normal = [](Face face) { return -formulas::box_normal<double>(face); };
         s.formulas.facing_normal = [](const Vec3d& normal, const Vec3d&) { return normal; };
       },
       nullptr},
      {"box-face-missing", 31, "Quader", "One of the six planes is not tested: the front is open.",
       "five planes", "six planes", "not counted", "box.sdf", &take_box<&without_front_face>, nullptr},
      {"sphere-t-of-unit-direction", 32, "Kugel",
       "t belongs to the normalised direction, but the point is taken along the given one.",
       "p = p0 + t d with |d| t", "p = p0 + t d", "6 of 42", "scale-nonuniform.sdf",
       &take_sphere<&t_of_unit_direction>, nullptr},
      {"sphere-missed-from-inside", 32, "Kugel", "The smaller root is taken even when it is negative.",
       "min(t0, t1)", "the smallest t > 0", "1 of 42", "sphere-inside.sdf", &take_sphere<&nearer_root_only>,
       nullptr},
      {"last-hit-wins", 33, "Verfolgen von Strahlen", "Objects are not compared by depth.",
       "the last hit of the list", "the hit of the smallest t > 0", "2 of 42", "nearest-hit.sdf",
       [](Subject& s) { s.formulas.is_nearer = [](double, double, double) { return true; }; }, nullptr},
  };
}

}  // namespace plumb::faults
