// What is wrong with a graph of composites.
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

/// Cycles, nesting deeper than max_nesting, more than max_instances spheres, boxes and composites, and
/// transforms that are not finite or have no finite inverse. Takes time linear in the text, and where
/// transforms may overflow in max_visited_instances; with more, what may overflow is reported.
std::vector<HierarchyError> check_hierarchy(const Scene& scene);

/// The spheres and boxes some instance of which has a matrix or an inverse that is not finite, as they are
/// met in the order of for_each_instance, by looking at every one.
std::vector<ShapeId> shapes_that_overflow(const Scene& scene);

/// A superset of them in the order of the file, by bounds along all paths at once. Expects no cycle.
std::vector<ShapeId> shapes_that_may_overflow(const Scene& scene);

}  // namespace plumb
