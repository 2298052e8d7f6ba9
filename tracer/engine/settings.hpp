// What the engine chooses by itself. Tests choose otherwise; no choice changes the picture.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tracer/engine/tile.hpp"
#include "tracer/system/vectors.hpp"

namespace plumb::engine {

struct Settings {
  Vectors vectors = widest_vectors();
  /// With at most this many instances, shared composites are written out: one level is faster than two.
  std::uint64_t most_written_out = 65536;
  /// With at most this many objects, bundles of rays may be of any width.
  std::size_t few_objects = 64;
  /// false: every ray meets every shape, to measure what the hierarchy is worth. Above most_written_out,
  /// shared composites are still kept once.
  bool has_hierarchy = true;
  /// Size of the tiles that a thread renders at once: 1 to tile_edge.
  int tile_width = tile_edge, tile_height = tile_edge;
};

}  // namespace plumb::engine
