// What the engine chooses by itself; tests choose otherwise. No choice changes the picture.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tracer/engine/tile.hpp"
#include "tracer/system/vectors.hpp"

namespace plumb::engine {

struct Settings {
  Vectors vectors = widest_vectors();
  /// Up to so many instances in all, shared composites are written out: one level is faster than two.
  std::uint64_t most_written_out = 65536;
  /// Up to so many objects, bundles of rays may be of any width.
  std::size_t few_objects = 64;
  /// false: every ray meets every shape, for measuring what the hierarchy is worth. Shared composites are
  /// still kept once when there are more than most_written_out.
  bool has_hierarchy = true;
  /// Of the tiles that a thread renders at once: 1 to tile_edge.
  int tile_width = tile_edge, tile_height = tile_edge;
};

}  // namespace plumb::engine
