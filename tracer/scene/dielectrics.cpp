#include "tracer/scene/dielectrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "tracer/formulas/sphere.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb {
namespace {

/// Where a ray that starts strictly inside leaves; no value when it starts outside.
std::optional<double> exit_distance(const Shape& shape, const Ray<double>& ray) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    const Vec3d offset = ray.origin - sphere->center;
    if (glm::dot(offset, offset) >= sphere->radius * sphere->radius) return std::nullopt;
    return formulas::intersect_sphere(ray, sphere->center, sphere->radius, false);
  }
  const Box& box = std::get<Box>(shape.geometry);
  const bool inside =
      glm::all(glm::lessThan(box.min, ray.origin)) && glm::all(glm::lessThan(ray.origin, box.max));
  if (!inside) return std::nullopt;
  const auto hit = formulas::intersect_box(ray, Corners<double>{box.min, box.max}, no_face);
  return hit ? std::optional(hit->t) : std::nullopt;
}

/// Far more than products of matrices round, so that no glass is passed by: all that costs is a look at more.
constexpr double slack = 1e-9;

/// A box around the glass of a subtree, with room for rounding; empty at first.
struct Room {
  Vec3d min{std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity()};

  void include(const Vec3d& low, const Vec3d& high) {
    min = glm::min(min, low);
    max = glm::max(max, high);
  }
  /// What is not a number counts as inside.
  bool excludes(const Vec3d& p, const Vec3d& margin) const {
    return glm::any(glm::lessThan(p + margin, min)) || glm::any(glm::greaterThan(p - margin, max));
  }
  /// Around what the matrix makes of it; everything when that overflows.
  Room moved(const Mat4<double>& m) const {
    const Vec3d middle = formulas::transform_point(m, (min + max) / 2.0);
    const Vec3d rounding =
        formulas::absolute_product(m, glm::max(glm::abs(min), glm::abs(max))) + glm::abs(Vec3d(m[3]));
    const Vec3d half = formulas::absolute_product(m, (max - min) / 2.0) + slack * rounding;
    const bool is_known = std::isfinite(glm::dot(Vec3d(1), half) + glm::dot(Vec3d(1), glm::abs(middle)));
    return is_known ? Room{middle - half, middle + half} : Room{-Room{}.min, -Room{}.max};
  }
};

/// Descends only where glass can be about the point, and counts the instances of the rest.
class Search {
 public:
  Search(const Scene& scene, const Ray<double>& ray)
      : scene_(scene), ray_(ray), counts_(count_instances(scene)) {
    for (const ShapeId id : order_of_composites(scene).children_first) add_room(id);
  }

  std::vector<EnclosingDielectric> run() {
    visit_all(scene_.roots(), Transform<double>{}, 0);
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Found& a, const Found& b) { return a.exit > b.exit; });
    std::vector<EnclosingDielectric> sorted;
    for (const Found& f : found_) sorted.push_back(f.dielectric);
    return sorted;
  }

 private:
  struct Found {
    double exit;
    EnclosingDielectric dielectric;
  };

  bool is_glass(MaterialId material) const { return scene_.materials[material].transmits(); }

  void add_room(ShapeId composite) {
    Room room;
    bool has_glass = false;
    for (const ShapeId id : children_of(scene_.shapes[composite])) {
      const std::optional<Room> child = room_in_parent(scene_.shapes[id], id);
      if (!child) continue;
      room.include(child->min, child->max);
      has_glass = true;
    }
    if (has_glass) rooms_.emplace(composite, room);
  }

  std::optional<Room> room_in_parent(const Shape& shape, ShapeId id) const {
    const Mat4<double> m = transform_of<double>(shape.transform).matrix;
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      if (!is_glass(sphere->material)) return std::nullopt;
      return Room{sphere->center - sphere->radius, sphere->center + sphere->radius}.moved(m);
    }
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      if (!is_glass(box->material)) return std::nullopt;
      return Room{box->min, box->max}.moved(m);
    }
    const auto room = rooms_.find(id);
    return room == rooms_.end() ? std::nullopt : std::optional(room->second.moved(m));
  }

  void visit_all(const std::vector<ShapeId>& children, const Transform<double>& parent,
                 std::uint64_t instance) {
    for (const ShapeId id : children) {
      visit(id, parent, instance);
      instance += counts_[id];
    }
  }

  void visit(ShapeId id, const Transform<double>& parent, std::uint64_t instance) {
    const Shape& shape = scene_.shapes[id];
    const MaterialId* material = material_of(shape);
    const auto room = rooms_.find(id);
    if (material == nullptr ? room == rooms_.end() : !is_glass(*material)) return;
    const Transform<double> here =
        shape.transform.empty() ? parent : formulas::compose(parent, transform_of<double>(shape.transform));
    Ray<double> ray = formulas::transform_ray(here.inverse, ray_);
    ray.world_length = formulas::absolute_product(here.inverse, ray_.world_length);
    if (material == nullptr) {
      const Vec3d rounding =
          formulas::absolute_product(here.inverse, glm::abs(ray_.origin)) + glm::abs(Vec3d(here.inverse[3]));
      if (room->second.excludes(ray.origin, slack * rounding)) return;
      visit_all(children_of(shape), here, instance);
    } else if (const auto exit = exit_distance(shape, ray)) {
      found_.push_back({*exit, {instance, scene_.materials[*material].eta}});
    }
  }

  const Scene& scene_;
  Ray<double> ray_;
  std::vector<std::uint64_t> counts_;
  std::unordered_map<ShapeId, Room> rooms_;  ///< of composites with glass below, in their own space
  std::vector<Found> found_;
};

}  // namespace

std::vector<EnclosingDielectric> dielectrics_around(const Scene& scene, const Vec3d& point,
                                                    const Vec3d& direction) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& m) { return m.transmits(); });
  return any ? Search(scene, Ray<double>{point, direction}).run() : std::vector<EnclosingDielectric>{};
}

}  // namespace plumb
