// Slide "Schatten".
#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

using formulas::ShadowRay;
using formulas::Toward;

/// A shadow ray that starts off the surface and does not know where it starts.
ShadowRay<double> from(const Vec3d& origin, const Toward<double>& to_light) {
  return {{origin, to_light.direction}, to_light.distance, false};
}

ShadowRay<double> offset_diagonally(const Vec3d& p, const Vec3d&, const Toward<double>& to_light,
                                    const Vec3d&) {
  return from(p + 0.001, to_light);
}

ShadowRay<double> offset_by_three_normals(const Vec3d& p, const Vec3d& n, const Toward<double>& to_light,
                                          const Vec3d&) {
  return from(p + 3.0 * n, to_light);
}

ShadowRay<double> offset_by_unnormalised(const Vec3d& p, const Vec3d&, const Toward<double>& to_light,
                                         const Vec3d&) {
  return from(p + 0.1 * to_light.distance * to_light.direction, to_light);
}

ShadowRay<double> offset_along_normal(const Vec3d& p, const Vec3d& n, const Toward<double>& to_light,
                                      const Vec3d&) {
  return from(p + 0.001 * n, to_light);
}

ShadowRay<double> without_offset(const Vec3d& p, const Vec3d&, const Toward<double>& to_light, const Vec3d&) {
  return from(p, to_light);
}

ShadowRay<double> toward_position(const Vec3d& p, const Vec3d&, const Toward<double>&, const Vec3d& light) {
  return {{p, glm::normalize(light)}, glm::length(light), true};
}

template <auto ray>
void take_shadow_ray(Subject& s) {
  s.formulas.shadow_ray = ray;
}

std::vector<Fault> of_the_blockers() {
  return {
      {"blocker-beyond-light", 19, "Schatten", "An object behind the light casts a shadow.", "t > 0",
       "0 < t < distance of the light", "26 of 42", "light-behind-is-no-blocker.sdf",
       [](Subject& s) { s.formulas.blocks_light = [](double t, double) { return t > 0; }; }, nullptr},
      {"shadow-distance-one", 19, "Schatten", "A hit is compared with the length of the normalised l, 1.",
       "0 < t < 1", "0 < t < distance of the light", "2 of 42", "shadow.sdf",
       [](Subject& s) { s.formulas.blocks_light = [](double t, double) { return t > 0 && t < 1; }; },
       nullptr},
      {"last-object-decides", 20, "Schatten", "Only the last object of the list can hide a light.",
       "delta = 0 if the last object lies between", "delta = 0 if any object lies between", "1 of 42",
       "shadow.sdf",
       [](Subject& s) {
         s.formulas.may_block = [](const formulas::Blocking& objects) {
           return objects.candidate == objects.last;
         };
       },
       nullptr},
      {"hidden-light-resets-all", 20, "Schatten", "A hidden light takes back what the lights before it gave.",
       "I = Ia ka when a light is hidden, then on", "I = I + 0 when a light is hidden", "1 of 42",
       "several-lights.sdf",
       [](Subject& s) {
         s.formulas.with_light = [](const Rgbd& so_far, const Rgbd& ambient, const Rgbd& light, bool) {
           return light == Rgbd(0) ? ambient : so_far + light;
         };
       },
       nullptr},
      {"one-blocker-darkens-all", 20, "Schatten", "What hides one light hides all of them.",
       "I = Ia ka when any light is hidden", "I = Ia ka + sum of the lights that are not hidden", "1 of 42",
       "several-lights.sdf",
       [](Subject& s) {
         s.formulas.with_light = [](const Rgbd& so_far, const Rgbd& ambient, const Rgbd& light,
                                    bool one_was_hidden) {
           return one_was_hidden || light == Rgbd(0) ? ambient : so_far + light;
         };
       },
       nullptr},
      {"no-self-shadow", 21, "Schatten", "An object is left out of its own shadow test.",
       "any other object lies between", "any object lies between, the lit one too", "2 of 42",
       "shadow-of-glass.sdf",
       [](Subject& s) {
         s.formulas.may_block = [](const formulas::Blocking& objects) {
           return objects.candidate != objects.lit;
         };
       },
       nullptr},
  };
}

/// Hits count from t = 0 on, whatever rounding can tell.
std::optional<double> sphere_from_zero(const Ray<double>& ray, const Vec3d& center, double radius,
                                       bool starts_on_it) {
  return formulas::intersect_sphere({ray.origin, ray.direction}, center, radius, starts_on_it);
}
std::optional<FaceHit<double>> box_from_zero(const Ray<double>& ray, const Corners<double>& box, Face start) {
  return formulas::intersect_box({ray.origin, ray.direction}, box, start);
}

std::vector<Fault> of_the_shadow_ray() {
  return {
      {"shadow-offset-diagonal", 21, "Schatten", "A number is added to all three coordinates of the start.",
       "p + (0.001 0.001 0.001)", "p", "2 of 42", "shadow.sdf", &take_shadow_ray<&offset_diagonally>,
       nullptr},
      {"shadow-offset-three-normals", 21, "Schatten", "The shadow ray starts three units above the surface.",
       "p + 3 n", "p", "1 of 42", "shadow.sdf", &take_shadow_ray<&offset_by_three_normals>, nullptr},
      {"shadow-offset-unnormalised", 21, "Schatten", "The offset grows with the distance of the light.",
       "p + 0.1 (light - p)", "p", "1 of 42", "shadow.sdf", &take_shadow_ray<&offset_by_unnormalised>,
       nullptr},
      {"shadow-offset-fixed", 21, "Schatten", "The offset is a length that fits scenes of one size only.",
       "p + 0.001 n", "p", "not counted", "shadow-small-units.sdf", &take_shadow_ray<&offset_along_normal>,
       nullptr},
      {"shadow-acne", 21, "Schatten", "By rounding, the surface casts spots of shadow on itself.",
       "t > 0, whatever it starts on", "the surface that it leaves is not met again", "not counted",
       "shadow.sdf",
       [](Subject& s) {
         s.formulas.shadow_ray = &without_offset;
         s.formulas.is_ahead = [](double t, double) { return t > 0; };
         s.formulas.intersect_sphere = &sphere_from_zero;
         s.formulas.intersect_box = &box_from_zero;
       },
       nullptr},
      {"shadow-toward-position", 22, "Schatten", "The shadow ray's direction is the light's position.",
       "l = light", "l = light - p", "1 of 42", "shadow.sdf", &take_shadow_ray<&toward_position>, nullptr},
  };
}

}  // namespace

std::vector<Fault> of_the_shadows() {
  std::vector<Fault> all = of_the_blockers();
  for (const Fault& fault : of_the_shadow_ray()) all.push_back(fault);
  return all;
}

}  // namespace plumb::faults
