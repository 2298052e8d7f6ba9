#include "tracer/scene/lights_on_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb {
namespace {

constexpr double rounding = 1e-14;  // of the largest number that a place is computed from
constexpr std::uint64_t most_looks = 1'000'000;

double largest_coordinate(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool is_on(const Sphere& sphere, const Vec3d& p) {
  const double near =
      rounding * std::max({largest_coordinate(p), largest_coordinate(sphere.center), sphere.radius});
  return std::abs(glm::length(p - sphere.center) - sphere.radius) <= near;
}

bool is_on(const Box& box, const Vec3d& p) {
  const double near =
      rounding * std::max({largest_coordinate(p), largest_coordinate(box.min), largest_coordinate(box.max)});
  const Vec3d below = p - box.min, above = box.max - p;  // not negative inside
  const double nearest = std::min({below.x, below.y, below.z, above.x, above.y, above.z});
  return std::abs(nearest) <= near;
}

class LightSearch {
 public:
  explicit LightSearch(const Scene& scene)
      : scene_(scene), roots_(scene.roots()), counts_(count_instances(scene)) {}

  bool is_too_long() const {
    std::uint64_t all = 0;
    for (const ShapeId root : roots_) all = saturating_add(all, counts_[root]);
    return scene_.lights.size() > most_looks / std::max<std::uint64_t>(1, all);
  }

  std::optional<ShapeId> at(const Vec3d& point) const { return among(roots_, point); }

 private:
  std::optional<ShapeId> among(const std::vector<ShapeId>& shapes, const Vec3d& point) const {
    for (const ShapeId id : shapes) {
      const Shape& shape = scene_.shapes[id];
      const Vec3d here = shape.transform.empty() ? point
                                                 : formulas::transform_point(
                                                       transform_of<double>(shape.transform).inverse, point);
      const auto of_itself = [&](bool is_on_it) { return is_on_it ? std::optional(id) : std::nullopt; };
      const auto found =
          std::visit(EachKind{[&](const Sphere& sphere) { return of_itself(is_on(sphere, here)); },
                              [&](const Box& box) { return of_itself(is_on(box, here)); },
                              [&](const Composite& composite) { return among(composite.children, here); }},
                     shape.geometry);
      if (found) return found;
    }
    return std::nullopt;
  }

  const Scene& scene_;
  std::vector<ShapeId> roots_;
  std::vector<std::uint64_t> counts_;
};

}  // namespace

std::vector<LightOnSurface> lights_on_surfaces(const Scene& scene) {
  std::vector<LightOnSurface> found;
  const LightSearch search(scene);
  if (search.is_too_long()) return found;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].intensity() == Rgbd(0)) continue;
    if (const auto shape = search.at(scene.lights[i].position)) found.push_back({i, *shape});
  }
  return found;
}

}  // namespace plumb
