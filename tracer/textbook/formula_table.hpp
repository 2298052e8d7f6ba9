// The formulas that the textbook tracer uses, one entry each. A replaced entry gives a tracer with another
// method, or with a known mistake, and changes nothing else.
#pragma once

#include "tracer/formulas/box.hpp"
#include "tracer/formulas/camera.hpp"
#include "tracer/formulas/phong.hpp"
#include "tracer/formulas/ray.hpp"
#include "tracer/formulas/secondary.hpp"
#include "tracer/formulas/sphere.hpp"
#include "tracer/formulas/transform.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::textbook {

template <class Real>
struct FormulaTable {
  // Kameramodell, Kameratransformation
  decltype(&formulas::image_plane_distance<Real>) image_plane_distance =
      &formulas::image_plane_distance<Real>;
  decltype(&formulas::image_plane_point<Real>) image_plane_point = &formulas::image_plane_point<Real>;
  decltype(&formulas::camera_ray<Real>) camera_ray = &formulas::camera_ray<Real>;
  decltype(&formulas::camera_matrix<Real>) camera_matrix = &formulas::camera_matrix<Real>;
  decltype(&pose_of<Real>) camera_pose = &pose_of<Real>;
  decltype(&formulas::world_ray<Real>) world_ray = &formulas::world_ray<Real>;
  // Transformationen, Anwendung
  decltype(&transform_of<Real>) transform_of = &plumb::transform_of<Real>;
  decltype(&formulas::transform_ray<Real>) transform_ray = &formulas::transform_ray<Real>;
  decltype(&formulas::transform_normal<Real>) transform_normal = &formulas::transform_normal<Real>;
  decltype(&formulas::unit_normal<Real>) unit_normal = &formulas::unit_normal<Real>;
  decltype(&formulas::point_in_parent<Real>) point_in_parent = &formulas::point_in_parent<Real>;
  // Strahl, Kugel, Quader
  decltype(&formulas::point_at<Real>) point_at = &formulas::point_at<Real>;
  decltype(&formulas::is_ahead<Real>) is_ahead = &formulas::is_ahead<Real>;
  decltype(&formulas::is_nearer<Real>) is_nearer = &formulas::is_nearer<Real>;
  decltype(&formulas::intersect_sphere<Real>) intersect_sphere = &formulas::intersect_sphere<Real>;
  decltype(&formulas::sphere_normal<Real>) sphere_normal = &formulas::sphere_normal<Real>;
  decltype(&formulas::intersect_box<Real>) intersect_box = &formulas::intersect_box<Real>;
  decltype(&formulas::box_normal<Real>) box_normal = &formulas::box_normal<Real>;
  // Lambert, Ambient, Phong, Vollstaendiges Modell, Schatten
  decltype(&formulas::facing_normal<Real>) facing_normal = &formulas::facing_normal<Real>;
  decltype(&formulas::toward_viewer<Real>) toward_viewer = &formulas::toward_viewer<Real>;
  decltype(&formulas::toward_light<Real>) toward_light = &formulas::toward_light<Real>;
  decltype(&formulas::arriving_light<Real>) arriving_light = &formulas::arriving_light<Real>;
  decltype(&formulas::diffuse_factor<Real>) diffuse_factor = &formulas::diffuse_factor<Real>;
  decltype(&formulas::light_counts<Real>) light_counts = &formulas::light_counts<Real>;
  decltype(&formulas::reflected_light<Real>) reflected_light = &formulas::reflected_light<Real>;
  decltype(&formulas::specular_factor<Real>) specular_factor = &formulas::specular_factor<Real>;
  decltype(&formulas::ambient_light<Real>) ambient_light = &formulas::ambient_light<Real>;
  decltype(&formulas::reflected_intensity<Real>) reflected_intensity = &formulas::reflected_intensity<Real>;
  decltype(&formulas::with_light<Real>) with_light = &formulas::with_light<Real>;
  decltype(&formulas::shadow_ray<Real>) shadow_ray = &formulas::shadow_ray<Real>;
  decltype(&formulas::may_block) may_block = &formulas::may_block;
  decltype(&formulas::blocks_light<Real>) blocks_light = &formulas::blocks_light<Real>;
  // Spiegelung, Brechung
  decltype(&formulas::secondary_origin<Real>) secondary_origin = &formulas::secondary_origin<Real>;
  decltype(&formulas::mirror_direction<Real>) mirror_direction = &formulas::mirror_direction<Real>;
  decltype(&formulas::refracted_direction<Real>) refracted_direction = &formulas::refracted_direction<Real>;
  decltype(&formulas::combined_colour<Real>) combined_colour = &formulas::combined_colour<Real>;
  decltype(&formulas::colour_at_total_reflection<Real>) colour_at_total_reflection =
      &formulas::colour_at_total_reflection<Real>;
  decltype(&formulas::is_too_deep) is_too_deep = &formulas::is_too_deep;
};

/// Gives the tracer the lecture's formulas, which the compiler knows.
template <class Real>
struct LectureFormulas {
  const FormulaTable<Real>* operator->() const { return &table; }
  static constexpr FormulaTable<Real> table{};
};

/// Gives the tracer the formulas of any table; each call goes through a pointer.
template <class Real>
struct ReplaceableFormulas {
  // Not explicit, so that a table serves wherever formulas are asked for.
  ReplaceableFormulas(const FormulaTable<Real>& entries) : table(entries) {}
  const FormulaTable<Real>* operator->() const { return &table; }
  FormulaTable<Real> table;
};

}  // namespace plumb::textbook
