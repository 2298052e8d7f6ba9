#include "references/attribution/perturbation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::references {
namespace {

/// Of the way to a box. An entry of the table has no state of its own, so it is the thread's.
thread_local double touched_edge = 0;

/// Where a ray only touches the edge of a box, it enters and leaves at once: this takes the face it leaves
/// by.
std::optional<FaceHit<double>> leaving_at_edges(const Ray<double>& ray, const Corners<double>& box,
                                                Face start) {
  const auto hit = formulas::intersect_box(ray, box, start);
  if (!hit || start != no_face) return hit;
  const auto leaving =
      formulas::intersect_box({formulas::point_at(ray, hit->t), ray.direction}, box, hit->face);
  return leaving && leaving->t <= touched_edge * hit->t ? FaceHit<double>{hit->t, leaving->face} : *hit;
}

/// What is as near to the lit point, or to the light, as that is taken for the surface itself, or the light.
thread_local double nearest_blocker = 0;

bool blocks_from_afar(double t, double light_distance) {
  return t > nearest_blocker && t < light_distance - nearest_blocker;
}

/// What is as near to the start of a ray is not met at all: of surfaces that coincide one is crossed.
thread_local double nearest_hit = 0;

bool is_far_ahead(double t, double rounding) { return t > rounding && t > nearest_hit; }

/// Of two hits that are as near to each other either is taken, each time by chance.
thread_local std::minstd_rand chance;

bool is_nearer_or_by_chance(double t, double nearest, double) {
  return std::abs(t - nearest) <= nearest_hit ? (chance() & 1U) != 0 : t < nearest;
}

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

Perturbation::Perturbation(const Scene& scene, const Camera& camera, const Resolution& resolution)
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

textbook::FormulaTable<double> Perturbation::formulas(int pattern) {
  textbook::FormulaTable<double> table;
  if (pattern % 2 == 1) table.intersect_box = &leaving_at_edges;
  if (pattern % 4 > 1) table.blocks_light = &blocks_from_afar;
  if (pattern % 16 > 7) {
    table.is_ahead = &is_far_ahead;
    table.is_nearer = &is_nearer_or_by_chance;
  }
  return table;
}

textbook::FormulaTable<double> Perturbation::reference_shadows() {
  textbook::FormulaTable<double> table;
  table.blocks_light = &blocks_from_afar;
  return table;
}

void Perturbation::begin_pixel(int pattern, std::size_t pixel) const {
  nearest_hit = step_;
  nearest_blocker = resolution_.steps_to_blocker * nearest_hit;
  touched_edge = resolution_.touched_edge;
  chance.seed(static_cast<std::uint32_t>(pattern) * 7919U + static_cast<std::uint32_t>(pixel) + 1U);
}

}  // namespace plumb::references
