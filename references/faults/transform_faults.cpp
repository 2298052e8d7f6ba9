// Slides "Transformationen", "Zusammengesetzt, Inverse", "Anwendung", "Objekttransformation", "Composite,
// DAG".
#include <glm/matrix.hpp>
#include <numbers>

#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

using Placed = Transform<double>;
using Steps = std::vector<TransformStep>;

Placed of_step(const TransformStep& step) { return plumb::transform_of<double>(Steps{step}); }

/// Inverts numerically, for matrices that are no products of known ones any more.
Placed inverted(const Mat4<double>& matrix) { return {matrix, glm::inverse(matrix)}; }

/// Returns the transform of steps whose rotations `change` has changed.
template <auto change>
Placed with_rotations(const Steps& steps) {
  Steps changed = steps;
  for (TransformStep& step : changed) {
    if (auto* rotation = std::get_if<Rotate>(&step)) change(*rotation);
  }
  return plumb::transform_of<double>(changed);
}

void only_about_unit_axes(Rotate& rotation) {
  const Vec3d& axis = rotation.axis;
  const bool is_unit_axis = axis == Vec3d(1, 0, 0) || axis == Vec3d(0, 1, 0) || axis == Vec3d(0, 0, 1);
  if (!is_unit_axis) rotation.degrees = 0;
}

void half_the_angle(Rotate& rotation) { rotation.degrees /= 2; }

/// Turns the other way round about one of the axes of space.
template <int axis>
void other_sense(Rotate& rotation) {
  Vec3d rest = rotation.axis;
  rest[axis] = 0;
  if (rest == Vec3d(0)) rotation.degrees = -rotation.degrees;
}

void other_sense_always(Rotate& rotation) { rotation.degrees = -rotation.degrees; }

void degrees_as_radians(Rotate& rotation) { rotation.degrees *= 180 / std::numbers::pi; }

Placed inverse_in_wrong_order(const Steps& steps) {
  Placed all;
  for (const TransformStep& step : steps) {
    const Placed one = of_step(step);
    all = {one.matrix * all.matrix, one.inverse * all.inverse};
  }
  return all;
}

/// Makes the last row of the sum 0 0 0 1 again, because points are not divided by their w.
Placed translations_added(const Steps& steps) {
  Mat4<double> sum(1);
  for (const TransformStep& step : steps) {
    const Mat4<double> one = of_step(step).matrix;
    sum = std::holds_alternative<Translate>(step) ? sum + one : one * sum;
    sum[3].w = 1;
  }
  return inverted(sum);
}

/// A translation in the last row adds to w only, which nobody divides by.
Placed translations_lost(const Steps& steps) {
  Steps kept = steps;
  std::erase_if(kept, [](const TransformStep& step) { return std::holds_alternative<Translate>(step); });
  return plumb::transform_of<double>(kept);
}

Ray<double> normalised_ray(const Mat4<double>& m, const Ray<double>& ray) {
  const Ray<double> moved = formulas::transform_ray(m, ray);
  return {moved.origin, glm::normalize(moved.direction)};
}

Vec3d mapped_back(const formulas::HitInTwoSpaces<double>& hit) {
  return formulas::transform_point(hit.parent_from_object.matrix, hit.object_point);
}

/// Normalises as four numbers, the fourth of which is what the translation left there.
Vec3d normal_with_w(const Mat4<double>& inverse, const Vec3d& n) {
  const Vec3d moved = formulas::transform_normal(inverse, n);
  const double w = glm::dot(Vec3d(inverse[3]), n);
  return moved / std::sqrt(glm::dot(moved, moved) + w * w);
}

Vec3d left_as_it_is(const Vec3d& n) { return n; }

template <auto transform>
void take_transform(Subject& s) {
  s.formulas.transform_of = transform;
}

std::vector<Fault> of_the_spaces() {
  return {
      {"object-space-t", 23, "Objekttransformation",
       "The ray's direction is normalised in object space, and t of different objects compared.",
       "d' = M^-1 d / |M^-1 d|", "d' = M^-1 d, not normalised", "14 of 30", "object-transform-depth.sdf",
       [](Subject& s) {
         s.formulas.transform_ray = &normalised_ray;
         s.formulas.point_in_parent = &mapped_back;
       },
       nullptr},
      {"hit-left-in-object-space", 24, "Objekttransformation",
       "The point that is lit stays where it was met, in the object's space.", "p = p0' + t d'",
       "p = p0 + t d", "3 of 42", "translate.sdf",
       [](Subject& s) {
         s.formulas.point_in_parent = [](const formulas::HitInTwoSpaces<double>& hit) {
           return hit.object_point;
         };
       },
       nullptr},
      {"hit-mapped-by-inverse", 24, "Objekttransformation", "The hit is mapped back with the inverse matrix.",
       "p = M^-1 (p0' + t d')", "p = M (p0' + t d')", "1 of 42", "translate.sdf",
       [](Subject& s) {
         s.formulas.point_in_parent = [](const formulas::HitInTwoSpaces<double>& hit) {
           return formulas::transform_point(hit.parent_from_object.inverse, hit.object_point);
         };
       },
       nullptr},
      {"ray-by-matrix", 25, "Objekttransformation", "The ray is transformed by M instead of its inverse.",
       "ray' = M ray", "ray' = M^-1 ray", "2 of 42", "translate.sdf",
       [](Subject& s) {
         s.formulas.transform_ray = [](const Mat4<double>& inverse, const Ray<double>& ray) {
           return formulas::transform_ray(glm::inverse(inverse), ray);
         };
       },
       nullptr},
      {"composite-transform-ignored", 30, "Composite, DAG", "The matrix of a composite does nothing.",
       "M = M1", "M = M7 M5 M1", "10 of 19", "composite.sdf",
       [](Subject& s) {
         for (Shape& shape : s.scene.shapes) {
           if (is_composite(shape)) shape.transform.clear();
         }
       },
       nullptr},
      {"composite-hit-not-mapped-back", 30, "Composite, DAG",
       "The point that is lit stays in the space of the composite.", "p = M1 p'", "p = M7 M5 M1 p'",
       "2 of 19", "composite.sdf",
       [](Subject& s) {
         s.formulas.point_in_parent = [](const formulas::HitInTwoSpaces<double>& hit) {
           return hit.is_composite ? hit.object_point : formulas::point_in_parent(hit);
         };
       },
       nullptr},
  };
}

std::vector<Fault> of_the_normals() {
  return {
      {"normal-by-matrix", 26, "Anwendung", "The normal is transformed like a vector.", "n' = M n",
       "n' = (M^-1)^T n", "0 of 42", "normal-transform.sdf",
       [](Subject& s) {
         s.formulas.transform_normal = [](const Mat4<double>& inverse, const Vec3d& n) {
           return formulas::transform_vector(glm::inverse(inverse), n);
         };
       },
       nullptr},
      {"normal-not-transformed", 26, "Anwendung", "The normal stays in the object's space.", "n' = n",
       "n' = (M^-1)^T n", "1 of 42", "normal-transform.sdf",
       [](Subject& s) {
         s.formulas.transform_normal = [](const Mat4<double>&, const Vec3d& n) { return n; };
       },
       nullptr},
      {"normal-not-renormalised", 26, "Anwendung", "The transformed normal keeps its length.",
       "n' = (M^-1)^T n", "n' = (M^-1)^T n / |(M^-1)^T n|", "3 of 42", "normal-transform.sdf",
       [](Subject& s) {
         s.formulas.unit_normal = &left_as_it_is;
         s.formulas.sphere_normal = [](const Vec3d& p, const Vec3d& center) {
           return glm::normalize(p - center);
         };
       },
       nullptr},
      {"normal-with-w", 26, "Anwendung",
       "The normal is normalised together with the w that the translation left in it.",
       "n' = xyz of (M^-1)^T (n, 0) / |all four|", "n' = xyz / |xyz|", "3 of 42", "translate.sdf",
       [](Subject& s) {
         s.formulas.unit_normal = &left_as_it_is;
         s.formulas.transform_normal = &normal_with_w;
         s.formulas.sphere_normal = [](const Vec3d& p, const Vec3d& center) {
           return glm::normalize(p - center);
         };
       },
       nullptr},
  };
}

std::vector<Fault> of_the_matrices() {
  return {
      {"inverse-in-wrong-order", 27, "Zusammengesetzt, Inverse",
       "The inverses are multiplied in the order of the matrices.", "M^-1 = M2^-1 M1^-1 of M = M2 M1",
       "M^-1 = M1^-1 M2^-1", "2 of 42", "composed-trs.sdf", &take_transform<&inverse_in_wrong_order>,
       nullptr},
      {"translation-added", 27, "Transformationen", "The matrix of a translation is added.", "M + T", "T M",
       "1 of 42", "translate.sdf", &take_transform<&translations_added>, nullptr},
      {"translation-in-wrong-column", 27, "Transformationen",
       "The translation stands in the last row, where it moves nothing.", "T = last row (v, 1)",
       "T = last column (v, 1)", "1 of 42", "translate.sdf", &take_transform<&translations_lost>, nullptr},
      {"rotation-about-unit-axes-only", 28, "Transformationen",
       "A rotation about any axis but x, y and z does nothing.", "R = I for a skew axis",
       "R(angle, axis) for any axis", "6 of 42", "rotate-skew-axis.sdf",
       &take_transform<&with_rotations<&only_about_unit_axes>>, nullptr},
      {"rotation-by-half", 28, "Transformationen", "A rotation turns by half of its angle.", "R(angle / 2)",
       "R(angle)", "1 of 42", "rotate-axes.sdf", &take_transform<&with_rotations<&half_the_angle>>, nullptr},
      {"rotation-degrees-as-radians", 29, "Transformationen", "Degrees go into sin() and cos().",
       "cos(angle), angle in degrees", "cos(angle pi / 180)", "not counted", "rotate-axes.sdf",
       &take_transform<&with_rotations<&degrees_as_radians>>, nullptr},
  };
}

}  // namespace

std::vector<Fault> families_of_the_transforms() {
  constexpr const char* wrong = "R(-angle)";
  constexpr const char* right = "R(angle), counter-clockwise seen from the axis' end";
  constexpr const char* common = "among 26";
  return {
      {"rotation-sense", 28, "Transformationen", "Every rotation turns the other way round.", wrong, right,
       common, "rotate-axes.sdf", &take_transform<&with_rotations<&other_sense_always>>, nullptr},
      {"rotation-sense-about-x", 28, "Transformationen", "A rotation about x turns the other way round.",
       wrong, right, common, "rotate-axes.sdf", &take_transform<&with_rotations<&other_sense<0>>>, nullptr},
      {"rotation-sense-about-y", 28, "Transformationen", "A rotation about y turns the other way round.",
       wrong, right, common, "rotate-axes.sdf", &take_transform<&with_rotations<&other_sense<1>>>, nullptr},
      {"rotation-sense-about-z", 28, "Transformationen", "A rotation about z turns the other way round.",
       wrong, right, common, "rotate-axes.sdf", &take_transform<&with_rotations<&other_sense<2>>>, nullptr},
  };
}

std::vector<Fault> of_the_transforms() {
  std::vector<Fault> all;
  for (const auto& part : {of_the_spaces(), of_the_normals(), of_the_matrices()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace plumb::faults
