// Slide "Verfolgen von Strahlen": raycast, trace, shade, as the lecture draws them.
#pragma once

#include <stdexcept>
#include <vector>

#include "tracer/scene/render_options.hpp"
#include "tracer/textbook/interiors.hpp"
#include "tracer/textbook/observer.hpp"
#include "tracer/textbook/world.hpp"

namespace plumb::textbook {

/// Traces the pixels of one camera's picture. The world must outlive it.
template <class Real, class Formulas = ReplaceableFormulas<Real>, class Observer = NoObserver<Real>>
class Tracer {
 public:
  Tracer(const World<Real, Formulas>& world, const Camera& camera, int width, int height,
         const RenderOptions& options, Observer observer = {})
      : world_(world),
        f_(world.formulas()),
        width_(width),
        height_(height),
        options_(options),
        observer_(observer),
        around_the_eye_(world.dielectrics_around(pose_of<Real>(camera))),
        ahead_(interiors_of(around_the_eye_.ahead())) {
    const CameraPose<Real> pose = f_->camera_pose(camera);
    eye_ = pose.eye;
    world_from_camera_ = f_->camera_matrix(pose.eye, pose.direction, pose.up);
    distance_ = f_->image_plane_distance(static_cast<Real>(camera.fov_x_degrees));
  }

  /// Returns the linear colour of the ray through the pixel's centre. Row 0 is the top row.
  Rgb<Real> raycast(int x, int y) const {
    const Vec2<Real> on_plane = f_->image_plane_point(x, y, width_, height_);
    Ray<Real> ray = f_->world_ray(world_from_camera_, f_->camera_ray(on_plane, distance_));
    int rays = 0;
    if (!around_the_eye_.is_on_surface()) return trace(RayKind::camera, ray, {}, ahead_, {&rays});
    ray.t_min = around_the_eye_.t_min();
    return trace(RayKind::camera, ray, {}, interiors_of(around_the_eye_.of_ray(ray.direction)), {&rays});
  }

 private:
  static Interiors<Real> interiors_of(const std::vector<EnclosingDielectric>& outermost_first) {
    Interiors<Real> inside;
    for (const EnclosingDielectric& around : outermost_first)
      inside.cross(around.instance, static_cast<Real>(around.eta));
    return inside;
  }

  /// How a ray follows from the camera's.
  struct Path {
    int* rays;       ///< of the pixel, that were traced before
    int depth = 0;   ///< counts the rays from the camera's to this one
    int unbent = 0;  ///< surfaces that were crossed without raising it

    Path deeper() const { return {rays, depth + 1}; }
  };

  Rgb<Real> trace(RayKind kind, const Ray<Real>& ray, SurfaceId start, const Interiors<Real>& interiors,
                  const Path& path) const {
    if (!observer_.ray_begins(kind, ray, path.depth)) return Rgb<Real>(0);
    const Rgb<Real> colour = follow(ray, start, interiors, path);
    observer_.ray_ends(colour);
    return colour;
  }

  Rgb<Real> follow(const Ray<Real>& ray, SurfaceId start, const Interiors<Real>& interiors,
                   const Path& path) const {
    if (f_->is_too_deep(path.depth, options_.depth, (*path.rays)++)) {
      observer_.is_black_at_depth_limit();
      return Rgb<Real>(0);
    }
    const Ray<Real> from_place = world_.with_t_min(ray);
    const Hit<Real> hit = world_.nearest_hit(from_place, start);
    if (hit.surface.instance == no_instance) return world_.background();
    return shade(from_place, hit, interiors, path);
  }

  Rgb<Real> shade(const Ray<Real>& ray, const Hit<Real>& hit, const Interiors<Real>& interiors,
                  const Path& path) const {
    const Surface<Real> surface = world_.surface(ray, hit);
    const Material<Real>& material = *surface.material;
    const Vec3<Real>& point = surface.point;
    const Vec3<Real> n = f_->facing_normal(f_->unit_normal(surface.normal), ray.direction);
    observer_.meets(hit, surface, point, n);

    const Rgb<Real> ambient = f_->ambient_light(world_.ambient(), material.ka);
    Rgb<Real> colour = ambient;
    bool one_was_hidden = false;
    for (std::size_t light = 0; light < world_.lights().size(); ++light) {
      const Rgb<Real> added = lit_by(light, ray, point, n, hit, material);
      colour = f_->with_light(colour, ambient, added, one_was_hidden);
      one_was_hidden = one_was_hidden || added == Rgb<Real>(0);
    }
    if (!material.transmits && !material.mirrors) return colour;

    const Ray<Real> mirrored = leave(ray, point, n, f_->mirror_direction(ray.direction, n));
    Rgb<Real> refracted(0);
    if (material.transmits) {
      Interiors<Real> beyond = interiors;
      const Real ratio = beyond.cross(hit.surface.instance, material.eta);
      const auto bent = ratio == 1 ? ray.direction : f_->refracted_direction(ray.direction, n, ratio);
      if (!bent)
        return f_->colour_at_total_reflection(
            colour, trace(RayKind::totally_reflected, mirrored, hit.surface, interiors, path.deeper()));
      refracted = ratio == 1 ? go_on_unbent(leave(ray, point, n, *bent), hit.surface, beyond, path)
                             : trace(RayKind::refracted, leave(ray, point, n, *bent), hit.surface, beyond,
                                     path.deeper());
    }
    const Rgb<Real> reflected =
        material.mirrors ? trace(RayKind::mirrored, mirrored, hit.surface, interiors, path.deeper())
                         : Rgb<Real>(0);
    return f_->combined_colour(colour, material.mirror, reflected, material.transmit, refracted);
  }

  /// Returns the ray that leaves `point`. It is no surer of its origin than the ray that found the point.
  Ray<Real> leave(const Ray<Real>& found_by, const Vec3<Real>& point, const Vec3<Real>& n,
                  const Vec3<Real>& direction) const {
    return {f_->secondary_origin(point, n, direction), direction, found_by.t_min};
  }

  /// Returns the diffuse and specular light of one source; black when it is behind the surface or hidden.
  Rgb<Real> lit_by(std::size_t index, const Ray<Real>& found_by, const Vec3<Real>& point, const Vec3<Real>& n,
                   const Hit<Real>& hit, const Material<Real>& material) const {
    const Light<Real>& light = world_.lights()[index];
    const auto to_light = f_->toward_light(point, light.position);
    LightSeen<Real> seen{f_->diffuse_factor(n, to_light.direction), to_light.distance, false};
    seen.counts = f_->light_counts(seen.cos_theta);
    if (seen.counts) {
      auto shadow = f_->shadow_ray(point, n, to_light, light.position);
      shadow.ray.t_min = found_by.t_min;
      seen.delta = visibility(index, shadow, hit.surface, seen.blocker);
      if (seen.delta != Rgb<Real>(0)) {
        const Vec3<Real> v = f_->toward_viewer({found_by.direction, point, eye_});
        const Vec3<Real>& l = to_light.direction;
        seen.specular_factor = f_->specular_factor(f_->reflected_light(n, l), v, l, material.m);
      }
    }
    observer_.is_lit_by(index, seen);
    if (seen.delta == Rgb<Real>(0)) return seen.delta;
    const Rgb<Real> intensity = f_->arriving_light(light.intensity, to_light.distance);
    return f_->reflected_intensity(intensity, seen.delta, material.kd, seen.cos_theta, material.ks,
                                   seen.specular_factor);
  }

  /// Slide "Schatten": 0 where an object lies strictly between point and light, else 1. The options decide on
  /// glass.
  Rgb<Real> visibility(std::size_t light, const formulas::ShadowRay<Real>& shadow, SurfaceId lit,
                       Hit<Real>& blocker) const {
    if (!options_.shadows) return Rgb<Real>(1);
    const SurfaceId start = shadow.knows_its_surface ? lit : SurfaceId{};
    if (options_.glass_shadow != GlassShadow::full)
      return visibility_through_glass(shadow.ray, start, shadow.light_distance, blocker);
    blocker = world_.blocker(shadow.ray, start, shadow.light_distance, lit.instance, light);
    return Rgb<Real>(blocker.surface.instance == no_instance ? 1 : 0);
  }

  Rgb<Real> visibility_through_glass(Ray<Real> ray, SurfaceId start, Real distance,
                                     Hit<Real>& blocker) const {
    Rgb<Real> delta(1);
    // A straight line crosses a convex object at most twice, which bounds the loop.
    for (InstanceId crossings = 0; crossings <= 2 * world_.instances(); ++crossings) {
      ray = world_.with_t_min(ray);
      ray.t_known = distance;
      const Hit<Real> hit = world_.nearest_hit(ray, start);
      if (hit.surface.instance == no_instance || !f_->blocks_light(hit.t, world_.before_light(ray, distance)))
        return delta;
      const Material<Real>& material = *world_.surface(ray, hit).material;
      if (!material.transmits) {
        blocker = hit;
        return Rgb<Real>(0);
      }
      if (options_.glass_shadow == GlassShadow::filtered) delta *= material.transmit;
      ray.origin = f_->point_at(ray, hit.t);
      start = hit.surface;
      distance -= hit.t;
    }
    return delta;
  }

  /// Decision: a ratio of exactly 1 does not bend and does not raise the depth, and is black on the last
  /// level.
  Rgb<Real> go_on_unbent(const Ray<Real>& ray, SurfaceId start, const Interiors<Real>& beyond,
                         const Path& path) const {
    if (path.unbent >= most_unbent) {
      throw std::runtime_error("a ray crosses more than 1000 surfaces of equal refractive index");
    }
    const bool is_last_level = path.depth + 1 >= options_.depth;
    return trace(RayKind::unbent, ray, start, beyond,
                 {path.rays, is_last_level ? options_.depth : path.depth, path.unbent + 1});
  }

  static constexpr int most_unbent = 1000;

  const World<Real, Formulas>& world_;
  const Formulas& f_;
  int width_;
  int height_;
  RenderOptions options_;
  Observer observer_;
  Mat4<Real> world_from_camera_;
  Real distance_;
  Vec3<Real> eye_;
  DielectricsAroundEye<Real> around_the_eye_;
  Interiors<Real> ahead_;
};

}  // namespace plumb::textbook
