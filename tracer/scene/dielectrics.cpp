#include "tracer/scene/dielectrics.hpp"

#include <algorithm>
#include <optional>

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

}  // namespace

std::vector<EnclosingDielectric> dielectrics_around(const Scene& scene, const Vec3d& point,
                                                    const Vec3d& direction) {
  const bool any = std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const Material& m) { return m.transmits(); });
  if (!any) return {};
  struct Found {
    double exit;
    EnclosingDielectric dielectric;
  };
  std::vector<Found> found;
  std::uint64_t number = 0;
  for_each_instance(scene, [&](const Instance& instance) {
    const std::uint64_t id = number++;
    const Shape& shape = scene.shapes[instance.shape];
    const Material& material = scene.materials[*material_of(shape)];
    if (!material.transmits()) return;
    const auto& inverse = instance.world_from_object.inverse;
    if (const auto exit =
            exit_distance(shape, formulas::transform_ray(inverse, Ray<double>{point, direction}))) {
      found.push_back({*exit, {id, material.eta}});
    }
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.exit > b.exit; });
  std::vector<EnclosingDielectric> sorted;
  for (const Found& f : found) sorted.push_back(f.dielectric);
  return sorted;
}

}  // namespace plumb
