#include "tracer/scene/dielectrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "tracer/formulas/quad.hpp"
#include "tracer/formulas/sphere.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb {
namespace {

double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

/// Returns where the ray leaves the shape, or no value where it enters it first or misses.
template <class Real>
std::optional<Real> exit_distance(const Sphere& sphere, const Ray<Real>& ray) {
  const Vec3<Real> center(sphere.center);
  const auto t = formulas::intersect_sphere(ray, center, static_cast<Real>(sphere.radius), false);
  if (!t) return std::nullopt;
  const Vec3<Real> normal = formulas::sphere_normal(formulas::point_at(ray, *t), center);
  return glm::dot(normal, ray.direction) > 0 ? t : std::nullopt;
}
template <class Real>
std::optional<Real> exit_distance(const Box& box, const Ray<Real>& ray) {
  const auto hit =
      formulas::intersect_box(ray, Corners<Real>{Vec3<Real>(box.min), Vec3<Real>(box.max)}, no_face);
  if (!hit) return std::nullopt;
  return glm::dot(formulas::box_normal<Real>(hit->face), ray.direction) > 0 ? std::optional(hit->t)
                                                                            : std::nullopt;
}

/// Returns the largest of the numbers that the shape is made of.
double size_of(const Sphere& sphere) { return largest(glm::abs(sphere.center)) + sphere.radius; }
double size_of(const Box& box) { return largest(glm::max(glm::abs(box.min), glm::abs(box.max))); }

/// True if a surface of the shape is within the margin, or if that is no number.
bool is_near_surface(const Sphere& sphere, const Vec3d& place, double margin) {
  return !(std::abs(glm::length(place - sphere.center) - sphere.radius) > margin);
}
bool is_near_surface(const Box& box, const Vec3d& place, double margin) {
  const Vec3d outside = glm::max(box.min - place, place - box.max);  // negative between two planes
  return !(std::abs(std::max({outside.x, outside.y, outside.z})) > margin);
}

/// Far more than products of matrices round, so that no glass is missed. It only costs a look at more glass.
template <class Real>
constexpr double slack = std::max(1e-9, 4 * static_cast<double>(formulas::resolution<Real>()));

/// A box around the glass of a subtree, with room for rounding; empty at first.
struct Room {
  Vec3d min{std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity()};

  void include(const Vec3d& low, const Vec3d& high) {
    min = glm::min(min, low);
    max = glm::max(max, high);
  }
  /// What is not a number counts as inside.
  bool excludes(const Vec3d& p, double margin) const {
    return glm::any(glm::lessThan(p + margin, min)) || glm::any(glm::greaterThan(p - margin, max));
  }
  /// Returns the room around its image under the matrix; everything when that overflows.
  Room moved(const Mat4<double>& m) const {
    const Vec3d middle = formulas::transform_point(m, (min + max) / 2.0);
    const Vec3d rounding =
        formulas::absolute_product(m, glm::max(glm::abs(min), glm::abs(max))) + glm::abs(Vec3d(m[3]));
    const Vec3d half = formulas::absolute_product(m, (max - min) / 2.0) + slack<double> * rounding;
    const bool is_known = std::isfinite(glm::dot(Vec3d(1), half) + glm::dot(Vec3d(1), glm::abs(middle)));
    return is_known ? Room{middle - half, middle + half} : Room{-Room{}.min, -Room{}.max};
  }
};

}  // namespace

/// Descends only where glass can be around the eye, and counts the instances of the rest.
template <class Real>
class DielectricsAroundEye<Real>::Search {
 public:
  Search(const Scene& scene, const Vec3<Real>& eye, const Vec3<Real>& ahead)
      : scene_(scene), ray_{eye, ahead}, counts_(count_instances(scene)) {
    for (const ShapeId id : order_of_composites(scene).children_first) add_room(id);
    ray_.t_min = formulas::resolution<Real>() * static_cast<Real>(largest(glm::abs(Vec3d(eye))));
    visit_all(scene_.roots(), Transform<Real>{}, 0);
    // Glass that the camera does not look into lies innermost, because it is left first.
    for (Glass& glass : glass_)
      if (glass.is_near) glass.exit = exit_of(glass, ray_.direction).value_or(0);
    std::stable_sort(glass_.begin(), glass_.end(),
                     [](const Glass& a, const Glass& b) { return a.exit > b.exit; });
  }

  bool is_on_surface() const {
    return std::any_of(glass_.begin(), glass_.end(), [](const Glass& glass) { return glass.is_near; });
  }
  Real t_min() const { return ray_.t_min; }

  std::vector<EnclosingDielectric> along(const Vec3<Real>& direction) const {
    std::vector<EnclosingDielectric> around;
    for (const Glass& glass : glass_)
      if (!glass.is_near || exit_of(glass, direction)) around.push_back(glass.dielectric);
    return around;
  }

 private:
  /// Glass that the eye is inside of, or as near to as rounding can tell.
  struct Glass {
    EnclosingDielectric dielectric;
    Real exit;  ///< ahead of the camera
    bool is_near;
    const Shape* shape;
    Transform<Real> world_from_object;
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
    using MaybeRoom = std::optional<Room>;
    const auto room = std::visit(
        EachKind{[&](const Sphere& sphere) {
                   const Room own{sphere.center - sphere.radius, sphere.center + sphere.radius};
                   return is_glass(sphere.material) ? MaybeRoom(own) : std::nullopt;
                 },
                 [&](const Box& box) {
                   return is_glass(box.material) ? MaybeRoom(Room{box.min, box.max}) : std::nullopt;
                 },
                 [&](const Composite&) {
                   const auto known = rooms_.find(id);
                   return known == rooms_.end() ? std::nullopt : MaybeRoom(known->second);
                 }},
        shape.geometry);
    return room ? MaybeRoom(room->moved(m)) : std::nullopt;
  }

  void visit_all(const std::vector<ShapeId>& children, const Transform<Real>& parent,
                 std::uint64_t instance) {
    for (const ShapeId id : children) {
      visit(id, parent, instance);
      instance += counts_[id];
    }
  }

  void visit(ShapeId id, const Transform<Real>& parent, std::uint64_t instance) {
    const Shape& shape = scene_.shapes[id];
    const MaterialId* material = material_of(shape);
    const auto room = rooms_.find(id);
    if (material == nullptr ? room == rooms_.end() : !is_glass(*material)) return;
    const Transform<Real> here =
        shape.transform.empty() ? parent : formulas::compose(parent, transform_of<Real>(shape.transform));
    const Vec3d place(ray_in(here, ray_.direction).origin);
    const auto look = [&](const auto& geometry) {
      add(geometry, place, {{instance, scene_.materials[*material].eta}, 0, false, &shape, here});
    };
    std::visit(EachKind{[&](const Sphere& sphere) { look(sphere); }, [&](const Box& box) { look(box); },
                        [&](const Composite& composite) {
                          if (!room->second.excludes(place, margin(here, 0)))
                            visit_all(composite.children, here, instance);
                        }},
               shape.geometry);
  }

  template <class Geometry>
  void add(const Geometry& geometry, const Vec3d& place, Glass glass) {
    const double size = size_of(geometry);
    glass.is_near = is_near_surface(geometry, place, margin(glass.world_from_object, size));
    if (glass.is_near) {
      const Mat4<double> m(glass.world_from_object.matrix);
      const double of_world = largest(formulas::absolute_product(m, Vec3d(size)) + glm::abs(Vec3d(m[3])));
      ray_.t_min = std::max(ray_.t_min, formulas::resolution<Real>() * static_cast<Real>(of_world));
    } else if (const auto exit = exit_of(glass, ray_.direction)) {
      glass.exit = *exit;
    } else {
      return;
    }
    glass_.push_back(glass);
  }

  Ray<Real> ray_in(const Transform<Real>& here, const Vec3<Real>& direction) const {
    Ray<Real> ray = formulas::transform_ray(here.inverse, Ray<Real>{ray_.origin, direction});
    ray.t_min = ray_.t_min;
    ray.world_length = formulas::absolute_product(here.inverse, ray_.world_length);
    return ray;
  }

  std::optional<Real> exit_of(const Glass& glass, const Vec3<Real>& direction) const {
    const Ray<Real> ray = ray_in(glass.world_from_object, direction);
    return std::visit(EachKind{[&](const Sphere& sphere) { return exit_distance(sphere, ray); },
                               [&](const Box& box) { return exit_distance(box, ray); },
                               [](const Composite&) { return std::optional<Real>(); }},
                      glass.shape->geometry);
  }

  /// Returns, in the space of a shape of that size, what the roundings of its surface and of the eye's place
  /// add up to.
  double margin(const Transform<Real>& here, double size) const {
    const Vec3d eye = glm::abs(Vec3d(ray_.origin));
    const Mat4<double> m(here.inverse);
    const Vec3d per_length = formulas::absolute_product(m, Vec3d(1));
    return slack<Real> * (largest(formulas::absolute_product(m, eye) + glm::abs(Vec3d(m[3]))) +
                          largest(eye) * largest(per_length) + size);
  }

  const Scene& scene_;
  Ray<Real> ray_;  ///< from the eye, ahead
  std::vector<std::uint64_t> counts_;
  std::unordered_map<ShapeId, Room> rooms_;  ///< of composites with glass below, in their own space
  std::vector<Glass> glass_;                 ///< outermost first
};

template <class Real>
DielectricsAroundEye<Real>::DielectricsAroundEye(const Scene& scene, const Vec3<Real>& eye,
                                                 const Vec3<Real>& direction) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& m) { return m.transmits(); });
  if (!any) return;
  const Vec3<Real> ahead = glm::normalize(direction);
  auto search = std::make_unique<Search>(scene, eye, ahead);
  ahead_ = search->along(ahead);
  if (search->is_on_surface()) search_ = std::move(search);
}
template <class Real>
DielectricsAroundEye<Real>::~DielectricsAroundEye() = default;
template <class Real>
DielectricsAroundEye<Real>::DielectricsAroundEye(DielectricsAroundEye&&) noexcept = default;

template <class Real>
Real DielectricsAroundEye<Real>::t_min() const {
  return search_ ? search_->t_min() : Real(0);
}

template <class Real>
std::vector<EnclosingDielectric> DielectricsAroundEye<Real>::of_ray(const Vec3<Real>& direction) const {
  return search_ ? search_->along(direction) : ahead_;
}

template class DielectricsAroundEye<float>;
template class DielectricsAroundEye<double>;
template class DielectricsAroundEye<long double>;
template class DielectricsAroundEye<Quad>;

std::vector<EnclosingDielectric> dielectrics_around(const Scene& scene, const Vec3d& point,
                                                    const Vec3d& direction) {
  return DielectricsAroundEye<double>(scene, point, direction).ahead();
}

}  // namespace plumb
