// Builds a bounding volume hierarchy with eight children per node.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tracer/engine/compiled_scene.hpp"

namespace plumb::engine {

/// Something to be found, and its bounds in the units of its group.
struct Item {
  std::array<float, 3> min;
  Ref ref;
  std::array<float, 3> max;
};

/// No leaf has more nodes above it: 64, and 30 more, each of which at least halves the items, at most 2^29.
inline constexpr std::size_t greatest_depth = 96;

/// Appends the nodes that hold all items and returns the root, or nothing for no items. Puts the items in
/// another order. Works top down, by the surface area heuristic over bins (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007), with several splits per node (Wald, Benthin, Boulos,
/// "Getting Rid of Packets", 2008). Builds large parts in parallel; the result is the same for every number
/// of threads.
Ref build_hierarchy(std::span<Item> items, std::vector<Node>& nodes);

}  // namespace plumb::engine
