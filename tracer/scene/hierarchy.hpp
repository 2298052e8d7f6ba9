// The graph of composites: slide "Composite, DAG".
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb {

struct HierarchyError {
  ShapeId shape;
  std::string message;
};

/// Cycles, nesting deeper than max_nesting, more than max_instances spheres and boxes, and
/// transforms that are not finite or have no finite inverse. Takes time linear in the text and in
/// max_instances.
std::vector<HierarchyError> check_hierarchy(const Scene& scene);

/// Spheres and boxes below each shape, a shared child counted once per path (saturating).
std::vector<std::uint64_t> count_instances(const Scene& scene);

/// One sphere or box as it stands in the world, reached over one path through the composites.
struct Instance {
  ShapeId shape;
  Transform<double> world_from_object;
};

/// Calls `use` for every sphere and box of the world, depth first in the order of the file.
/// Expects a scene without hierarchy errors.
void for_each_instance(const Scene& scene, const std::function<void(const Instance&)>& use);

}  // namespace plumb
