// Checks a graph of composites.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/hierarchy.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb {

struct HierarchyError {
  ShapeId shape;
  std::string message;
};

/// Reports cycles, nesting deeper than max_nesting, more than max_instances spheres, boxes and composites,
/// and transforms that are not finite or have no finite inverse. Takes time linear in the text. Where
/// transforms may overflow, it also visits each instance; in scenes above max_visited_instances it reports
/// what may overflow.
std::vector<HierarchyError> check_hierarchy(const Scene& scene);

/// Returns the spheres and boxes of which some instance has a matrix or an inverse that is not finite. Looks
/// at every instance, in the order of for_each_instance, which is that of the result.
std::vector<ShapeId> shapes_that_overflow(const Scene& scene);

/// Returns a superset of them in the order of the file, from bounds over all paths at once. Expects no cycle.
std::vector<ShapeId> shapes_that_may_overflow(const Scene& scene);

}  // namespace plumb
