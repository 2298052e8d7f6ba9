// Builds a bounding volume hierarchy with eight children a node.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tracer/engine/compiled_scene.hpp"

namespace plumb::engine {

/// Something to be found, and where: bounds in the units of its group.
struct Item {
  std::array<float, 3> min;
  Ref ref;
  std::array<float, 3> max;
};

/// No leaf has more nodes above it: 64 and, with the items at least halved from one to the next, 30 more for
/// 2^29.
inline constexpr std::size_t greatest_depth = 96;

/// Appends the nodes that hold all items, which are put in another order, and returns the root; nothing for
/// no items. Top down, by the surface area heuristic over bins (Wald, "On fast Construction of SAH-based
/// Bounding Volume Hierarchies", 2007), several splits a node (Wald, Benthin, Boulos, "Getting Rid of
/// Packets", 2008). Large parts are built in parallel; the result is the same for every number of threads.
Ref build_hierarchy(std::span<Item> items, std::vector<Node>& nodes);

}  // namespace plumb::engine
