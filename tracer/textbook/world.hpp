// A scene prepared for the textbook tracer, in one real type.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <vector>

#include "tracer/scene/dielectrics.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/textbook/shape.hpp"

namespace plumb::textbook {

template <class Real>
struct Light {
  Vec3<Real> position;
  Rgb<Real> intensity;  ///< Ip
};

/// Owns the hierarchy. Every shape of the scene is built once, however many parents it has.
template <class Real, class Formulas = ReplaceableFormulas<Real>>
class World {
 public:
  /// Expects a scene as read_scene returns it without errors; it must outlive the world.
  World(const Scene& scene, const Formulas& formulas) : scene_(scene), formulas_(formulas) {
    ambient_ = Rgb<Real>(scene.ambient);
    background_ = Rgb<Real>(scene.background);
    for (const auto& m : scene.materials) {
      materials_.push_back({Rgb<Real>(m.ka), Rgb<Real>(m.kd), Rgb<Real>(m.ks), static_cast<Real>(m.m),
                            Rgb<Real>(m.mirror), Rgb<Real>(m.transmit), static_cast<Real>(m.eta), m.mirrors(),
                            m.transmits()});
    }
    for (const auto& l : scene.lights) lights_.push_back({Vec3<Real>(l.position), Rgb<Real>(l.intensity())});
    std::vector<std::shared_ptr<const Shape<Real, Formulas>>> built(scene.shapes.size());
    std::vector<std::shared_ptr<const Shape<Real, Formulas>>> roots;
    for (const ShapeId id : scene.roots()) roots.push_back(build(scene, id, built));
    root_ = std::make_shared<Composite<Real, Formulas>>(Transform<Real>{}, std::move(roots));
  }

  const Formulas& formulas() const { return formulas_; }
  const std::vector<Light<Real>>& lights() const { return lights_; }
  const Rgb<Real>& ambient() const { return ambient_; }
  const Rgb<Real>& background() const { return background_; }
  InstanceId instances() const { return root_->instances(); }

  /// Returns the glass that a camera is inside of.
  DielectricsAroundEye<Real> dielectrics_around(const CameraPose<Real>& pose) const {
    return {scene_, pose.eye, pose.direction};
  }

  /// Returns the ray with a t_min up to which nothing can be told from its origin; a larger one is kept.
  static Ray<Real> with_t_min(const Ray<Real>& ray) {
    const Vec3<Real> size = glm::abs(ray.origin);
    const Real here = formulas::resolution<Real>() * std::max({size.x, size.y, size.z});
    Ray<Real> known = ray;
    known.t_min = std::max(ray.t_min, here);
    return known;
  }

  /// Returns the nearest hit with t > 0, if any, of a ray of unit direction that starts on `start` (or in
  /// free space).
  Hit<Real> nearest_hit(const Ray<Real>& ray, SurfaceId start) const {
    Hit<Real> nearest;
    root_->intersect({formulas_, start}, with_t_min(ray), 0, nearest);
    return nearest;
  }

  /// Returns any object that blocks a light at `light_distance` along the ray of unit direction, which comes
  /// from the instance `lit`. The hit is of no instance when none does.
  Hit<Real> blocker(const Ray<Real>& ray, SurfaceId start, Real light_distance, InstanceId lit,
                    std::size_t light) const {
    Hit<Real> found;
    Ray<Real> to_light = with_t_min(ray);
    to_light.t_known = before_light(ray, light_distance);
    root_->intersect({formulas_, start, true, to_light.t_known, lit, instances() - 1, light}, to_light, 0,
                     found);
    return found;
  }

  /// Returns the t up to which something on the ray hides a light. What is at one place with the light does
  /// not.
  Real before_light(const Ray<Real>& ray, Real light_distance) const {
    return light_distance - formulas::one_place(with_t_min(ray), light_distance);
  }

  Surface<Real> surface(const Ray<Real>& ray, const Hit<Real>& hit) const {
    return root_->surface({formulas_, {}}, ray, 0, hit);
  }

 private:
  using Built = std::vector<std::shared_ptr<const Shape<Real, Formulas>>>;

  std::shared_ptr<const Shape<Real, Formulas>> build(const Scene& scene, ShapeId id, Built& built) const {
    if (built[id]) return built[id];
    const plumb::Shape& shape = scene.shapes[id];
    const Transform<Real> placed = formulas_->transform_of(shape.transform);
    using Node = std::shared_ptr<const Shape<Real, Formulas>>;
    built[id] = std::visit(
        EachKind{[&](const plumb::Sphere& sphere) -> Node {
                   return std::make_shared<Sphere<Real, Formulas>>(placed, sphere,
                                                                   materials_[sphere.material], id);
                 },
                 [&](const plumb::Box& box) -> Node {
                   return std::make_shared<Box<Real, Formulas>>(placed, box, materials_[box.material], id);
                 },
                 [&](const plumb::Composite& composite) -> Node {
                   Built children;
                   for (const ShapeId child : composite.children)
                     children.push_back(build(scene, child, built));
                   return std::make_shared<Composite<Real, Formulas>>(placed, std::move(children));
                 }},
        shape.geometry);
    return built[id];
  }

  const Scene& scene_;
  Formulas formulas_;
  std::deque<Material<Real>> materials_;  // a deque, because shapes refer to its elements
  std::vector<Light<Real>> lights_;
  Rgb<Real> ambient_;
  Rgb<Real> background_;
  std::shared_ptr<const Composite<Real, Formulas>> root_;
};

}  // namespace plumb::textbook
