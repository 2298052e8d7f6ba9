#include "references/attribution/perturbation.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::attribution {
namespace {

/// Moves every face of a box, and the surface of a sphere, by `step` one way or the other.
void move_surface(Shape& shape, double step, std::mt19937& random) {
  const auto either = [&] { return (random() & 1U) != 0 ? step : -step; };
  std::visit(EachKind{[&](Sphere& sphere) {
                        sphere.radius = std::max(sphere.radius + either(), sphere.radius / 2);
                        sphere.center += Vec3d(either(), either(), either());
                      },
                      [&](Box& box) {
                        box.min += Vec3d(either(), either(), either());
                        box.max = glm::max(box.min, box.max + Vec3d(either(), either(), either()));
                      },
                      [](Composite&) {}},
             shape.geometry);
}

double size_of(const Shape& shape) {
  return std::visit(EachKind{[](const Sphere& sphere) { return sphere.radius; },
                             [](const Box& box) {
                               const Vec3d edges = box.max - box.min;
                               return std::max({edges.x, edges.y, edges.z});
                             },
                             [](const Composite&) { return 0.0; }},
                    shape.geometry);
}

/// How much the instances of each shape enlarge it at most.
std::vector<double> enlargements(const Scene& scene) {
  std::vector<double> enlargement(scene.shapes.size(), 0);
  for_each_instance(scene, [&](const Instance& instance) {
    const Mat4<double>& m = instance.world_from_object.matrix;
    for (int axis = 0; axis < 3; ++axis) {
      enlargement[instance.shape] = std::max(enlargement[instance.shape], glm::length(Vec3d(m[axis])));
    }
  });
  return enlargement;
}

constexpr double most_of_a_shape = 1e-5;

/// Adds a copy of the shape and of all below it; every child has one parent then. Returns its place.
ShapeId copy_apart(const Scene& from, ShapeId id, Scene& to) {
  const ShapeId copy = to.shapes.size();
  to.shapes.push_back(from.shapes[id]);
  std::vector<ShapeId> children;
  for (const ShapeId child : children_of(from.shapes[id])) children.push_back(copy_apart(from, child, to));
  if (auto* const own = own_children_of(to.shapes[copy])) *own = std::move(children);
  return copy;
}

}  // namespace

Scene with_instances_apart(const Scene& scene) {
  constexpr std::uint64_t most = 2000;
  const std::vector<ShapeId> roots = scene.roots();
  const std::vector<std::uint64_t> counts = count_instances(scene);
  std::uint64_t all = 0;
  for (const ShapeId root : roots) all += std::min(counts[root], most);
  if (all > most) return scene;
  Scene apart = scene;
  apart.shapes.clear();
  for (const ShapeId root : roots) copy_apart(scene, root, apart);
  return apart;
}

Perturbation::Perturbation(const Scene& scene, const Camera& camera, const renderers::Resolution& resolution)
    : scene_(scene),
      resolution_(resolution),
      extent_(resolution.extent(scene, camera)),
      step_(resolution.step * extent_),
      steps_(scene.shapes.size(), 0) {
  const double wanted = step_;
  const std::vector<double> enlargement = enlargements(scene);
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    const double size = size_of(scene.shapes[id]);
    if (enlargement[id] == 0 || size == 0) continue;
    steps_[id] = std::min(wanted / enlargement[id], most_of_a_shape * size);
    step_ = std::min(step_, most_of_a_shape * size * enlargement[id]);
  }
}

double Perturbation::factor(int pattern) { return pattern % 8 < 4 ? 1 : 1e-3; }

Scene Perturbation::moved(int pattern) const {
  std::mt19937 random(static_cast<std::uint32_t>(pattern) + 1);  // the same patterns every time
  Scene moved = scene_;
  for (ShapeId id = 0; id < moved.shapes.size(); ++id) {
    move_surface(moved.shapes[id], factor(pattern) * steps_[id], random);
  }
  return moved;
}

Scene Perturbation::with_one_moved(ShapeId shape, int pattern) const {
  std::mt19937 random(static_cast<std::uint32_t>(pattern) + 1);
  Scene moved = scene_;
  move_surface(moved.shapes[shape], steps_[shape], random);
  return moved;
}

PerturbedFormulas Perturbation::formulas(int pattern) const {
  PerturbedFormulas formulas;
  formulas.table.pattern = static_cast<std::uint32_t>(pattern);
  if (pattern % 2 == 1) formulas.table.touched_edge = resolution_.touched_edge;
  if (pattern % 4 > 1) formulas.table.nearest_blocker = nearest_blocker();
  if (pattern % 16 > 7) formulas.table.nearest_hit = step_;
  return formulas;
}

PerturbedFormulas Perturbation::reference_shadows() const {
  PerturbedFormulas formulas;
  formulas.table.nearest_blocker = nearest_blocker();
  return formulas;
}

double Perturbation::nearest_blocker() const { return resolution_.steps_to_blocker * step_; }

}  // namespace plumb::attribution
