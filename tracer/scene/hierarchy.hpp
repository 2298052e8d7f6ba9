// The graph of composites: slide "Composite, DAG".
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb {

/// Beyond these limits a scene is refused.
inline constexpr std::size_t max_nesting = 1000;  ///< levels of composites within composites
/// Number of shapes, a shared child counted once per path: the engine numbers them with 32 bits.
inline constexpr std::uint64_t max_instances = 4'000'000'000;
/// A scene with more is rendered, but not walked through instance by instance.
inline constexpr std::uint64_t max_visited_instances = 2'000'000;

/// An order of the composites in which each comes after its children, or what makes it impossible.
struct CompositeOrder {
  std::vector<ShapeId> children_first;  ///< composites only; not all of them when there is a cycle
  std::vector<ShapeId> cycle;  ///< each is a child of the one before it, the first of the last; or empty
};

/// Searches depth first (Tarjan, "Depth-first search and linear graph algorithms", SIAM J. Comput. 1, 1972)
/// in the order of the file.
CompositeOrder order_of_composites(const Scene& scene);

/// Returns, for each shape, the number of spheres and boxes that it consists of. A shared child counts once
/// per path; sums saturate.
std::vector<std::uint64_t> count_instances(const Scene& scene);

/// Returns the number of spheres, boxes and composites of the world, counted in the same way.
std::uint64_t count_nodes(const Scene& scene);

std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b);

/// One sphere or box as it stands in the world, reached on one path through the composites.
struct Instance {
  ShapeId shape;
  Transform<double> world_from_object;
};

/// Calls `use` for every sphere and box of the world, depth first in the order of the file. Their numbers
/// count from 0 in this order. Expects a scene without hierarchy errors. Throws SceneError when count_nodes()
/// exceeds max_visited_instances.
void for_each_instance(const Scene& scene, const std::function<void(const Instance&)>& use);

/// Finds the shape of an instance by its number, without a walk over all instances.
class InstanceShapes {
 public:
  /// Expects a scene without hierarchy errors, which must outlive this object.
  explicit InstanceShapes(const Scene& scene);

  /// Throws std::out_of_range when there is no such instance.
  ShapeId at(std::uint64_t instance) const;

 private:
  const Scene& scene_;
  std::vector<ShapeId> roots_;
  std::vector<std::uint64_t> counts_;
};

}  // namespace plumb
