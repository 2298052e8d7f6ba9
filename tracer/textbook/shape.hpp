// Slides "Objekttransformation" and "Composite, DAG": shapes that a ray meets in their own space.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tracer/textbook/formula_table.hpp"

namespace plumb::textbook {

/// The number of a sphere or box as it stands in the world: its place in a depth-first walk over all paths
/// through the composites. A shared child has one number per path.
using InstanceId = std::uint64_t;
inline constexpr InstanceId no_instance = std::numeric_limits<InstanceId>::max();

/// The surface that a ray starts on, or hits: an instance and, for a box, its face.
struct SurfaceId {
  InstanceId instance = no_instance;
  Face face = no_face;
  bool operator==(const SurfaceId&) const = default;
};

/// The nearest hit so far. t counts in lengths of the world ray's direction, in every space.
template <class Real>
struct Hit {
  Real t = std::numeric_limits<Real>::infinity();
  SurfaceId surface;
};

/// A material in the real type of the tracer.
template <class Real>
struct Material {
  Rgb<Real> ka, kd, ks;
  Real m;
  Rgb<Real> mirror, transmit;
  Real eta;
  bool mirrors, transmits;
};

/// What shading needs to know of a hit, found once the nearest hit is known.
template <class Real>
struct Surface {
  Vec3<Real> point;   ///< of the hit, in the caller's space
  Vec3<Real> normal;  ///< outward, in the caller's space, of any length
  const Material<Real>* material;
  ShapeId shape;
};

/// Returns the ray with the nearest hit so far in its t_known.
template <class Real>
Ray<Real> known_up_to(const Hit<Real>& nearest, Ray<Real> ray) {
  ray.t_known = std::min(ray.t_known, nearest.t);
  return ray;
}

/// What a ray carries through the hierarchy besides itself.
template <class Real, class Formulas>
struct Query {
  const Formulas& formulas;
  SurfaceId start;                ///< the surface where the ray starts: it is not met again at t = 0
  bool is_shadow_ray = false;     ///< true: any hit that blocks the light will do, not only the nearest
  Real light_distance = 0;        ///< from the start of a shadow ray
  InstanceId lit = no_instance;   ///< the instance that a shadow ray comes from
  InstanceId last = no_instance;  ///< the last instance of the world
  std::size_t light = 0;          ///< the number of the light that a shadow ray goes to

  /// True if a hit counts and comes before the nearest so far. Two hits that rounding cannot tell apart are
  /// one place. The first in the order of the file is taken there, so coincident surfaces are crossed once.
  bool is_nearer(const Ray<Real>& ray, InstanceId self, Real t, Real nearest) const {
    return formulas->is_ahead(t, ray.t_min) && formulas->is_nearer(t, nearest, formulas::one_place(ray, t)) &&
           (!is_shadow_ray ||
            (formulas->blocks_light(t, light_distance) && formulas->may_block({self, lit, last, light})));
  }
};

/// A node of the hierarchy. M places it in its parent's space. The ray times M^-1 meets it in its own space.
/// The ray's direction is not normalised, so t is valid in both.
template <class Real, class Formulas>
class Shape {
 public:
  explicit Shape(const Transform<Real>& parent_from_object)
      : parent_from_object_(parent_from_object), is_identity_(parent_from_object.matrix == Mat4<Real>(1)) {}
  virtual ~Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  virtual InstanceId instances() const = 0;
  virtual bool is_composite() const { return false; }

  /// Replaces `nearest` if a hit with 0 < t < nearest.t lies below this node. `ray` is in the parent's space;
  /// `first` is the number of the first instance below this node on the path taken.
  void intersect(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId first,
                 Hit<Real>& nearest) const {
    if (is_identity_) return intersect_here(query, ray, first, nearest);
    Ray<Real> in_object = query.formulas->transform_ray(parent_from_object_.inverse, ray);
    in_object.t_min = ray.t_min;
    in_object.t_known = ray.t_known;
    in_object.world_length = formulas::absolute_product(parent_from_object_.inverse, ray.world_length);
    intersect_here(query, in_object, first, nearest);
  }

  /// Returns the surface of a hit below this node, in the parent's space. (M^-1)^T transforms its normal.
  Surface<Real> surface(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId first,
                        const Hit<Real>& hit) const {
    if (is_identity_) return surface_here(query, ray, first, hit);
    Surface<Real> found =
        surface_here(query, query.formulas->transform_ray(parent_from_object_.inverse, ray), first, hit);
    found.normal = query.formulas->transform_normal(parent_from_object_.inverse, found.normal);
    found.point =
        query.formulas->point_in_parent({parent_from_object_, ray, hit.t, found.point, is_composite()});
    return found;
  }

 protected:
  virtual void intersect_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId first,
                              Hit<Real>& nearest) const = 0;
  virtual Surface<Real> surface_here(const Query<Real, Formulas>& query, const Ray<Real>& ray,
                                     InstanceId first, const Hit<Real>& hit) const = 0;

 private:
  Transform<Real> parent_from_object_;
  bool is_identity_;
};

template <class Real, class Formulas>
class Sphere final : public Shape<Real, Formulas> {
 public:
  Sphere(const Transform<Real>& parent_from_object, const plumb::Sphere& sphere,
         const Material<Real>& material, ShapeId shape)
      : Shape<Real, Formulas>(parent_from_object),
        center_(sphere.center),
        radius_(static_cast<Real>(sphere.radius)),
        material_(material),
        shape_(shape) {}

  InstanceId instances() const override { return 1; }

 private:
  void intersect_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId self,
                      Hit<Real>& nearest) const override {
    const auto t = query.formulas->intersect_sphere(known_up_to(nearest, ray), center_, radius_,
                                                    query.start.instance == self);
    if (t && query.is_nearer(ray, self, *t, nearest.t)) nearest = {*t, {self, no_face}};
  }
  Surface<Real> surface_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId,
                             const Hit<Real>& hit) const override {
    const Vec3<Real> point = query.formulas->point_at(ray, hit.t);
    return {point, query.formulas->sphere_normal(point, center_), &material_, shape_};
  }

  Vec3<Real> center_;
  Real radius_;
  const Material<Real>& material_;
  ShapeId shape_;
};

template <class Real, class Formulas>
class Box final : public Shape<Real, Formulas> {
 public:
  Box(const Transform<Real>& parent_from_object, const plumb::Box& box, const Material<Real>& material,
      ShapeId shape)
      : Shape<Real, Formulas>(parent_from_object),
        corners_{Vec3<Real>(box.min), Vec3<Real>(box.max)},
        material_(material),
        shape_(shape) {}

  InstanceId instances() const override { return 1; }

 private:
  void intersect_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId self,
                      Hit<Real>& nearest) const override {
    const Face start = query.start.instance == self ? query.start.face : no_face;
    const auto hit = query.formulas->intersect_box(known_up_to(nearest, ray), corners_, start);
    if (hit && query.is_nearer(ray, self, hit->t, nearest.t)) nearest = {hit->t, {self, hit->face}};
  }
  Surface<Real> surface_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId,
                             const Hit<Real>& hit) const override {
    return {query.formulas->point_at(ray, hit.t), query.formulas->box_normal(hit.surface.face), &material_,
            shape_};
  }

  Corners<Real> corners_;
  const Material<Real>& material_;
  ShapeId shape_;
};

/// An inner node: a matrix and children. A child may have several parents.
template <class Real, class Formulas>
class Composite final : public Shape<Real, Formulas> {
 public:
  Composite(const Transform<Real>& parent_from_object,
            std::vector<std::shared_ptr<const Shape<Real, Formulas>>> children)
      : Shape<Real, Formulas>(parent_from_object), children_(std::move(children)) {
    for (const auto& child : children_) {
      offsets_.push_back(instances_);
      instances_ += child->instances();
    }
  }

  InstanceId instances() const override { return instances_; }
  bool is_composite() const override { return true; }

 private:
  void intersect_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId first,
                      Hit<Real>& nearest) const override {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      children_[i]->intersect(query, ray, first + offsets_[i], nearest);
      if (query.is_shadow_ray && nearest.surface.instance != no_instance) return;
    }
  }
  Surface<Real> surface_here(const Query<Real, Formulas>& query, const Ray<Real>& ray, InstanceId first,
                             const Hit<Real>& hit) const override {
    const InstanceId offset = hit.surface.instance - first;
    const auto after = std::upper_bound(offsets_.begin(), offsets_.end(), offset);
    const auto child = static_cast<std::size_t>(after - offsets_.begin()) - 1;
    return children_[child]->surface(query, ray, first + offsets_[child], hit);
  }

  std::vector<std::shared_ptr<const Shape<Real, Formulas>>> children_;
  std::vector<InstanceId> offsets_;  // distance of each child's first instance from the composite's own
  InstanceId instances_ = 0;
};

}  // namespace plumb::textbook
