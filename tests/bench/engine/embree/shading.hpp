// The lecture's shading in float, sixteen rays at once; what tracer/textbook/tracer.hpp does one by one.
#pragma once

#include "tests/bench/engine/embree/batch.hpp"
#include "tests/bench/engine/embree/looks.hpp"
#include "tests/bench/engine/embree/objects.hpp"

namespace plumb::bench {

/// What is known of sixteen hits.
struct alignas(64) Surfaces {
  float point[3][lanes];
  float normal[3][lanes];  ///< unit, toward the viewer
  float offset[lanes];     ///< by which a new ray starts off the surface, against meeting it again
  std::int32_t material[lanes];
  int is_hit[lanes];
};

class Shader {
 public:
  Shader(const Looks& looks, const Objects& objects) : looks_(looks), objects_(objects) {}

  Surfaces surfaces(const Block& block) const;
  /// Sets the block's colour to the ambient light, or to the background.
  void begin(Block& block, const Surfaces& s) const;
  /// The rays to one light, and what it adds where it is seen.
  void light(std::size_t light, const Block& block, const Surfaces& s, ShadowBlock& shadow) const;
  /// Appends the mirrored and refracted rays of a block to `next`.
  void spawn(const Batch& batch, int block, const Surfaces& s, Batch& next) const;

 private:
  void spawn_one(const Batch& batch, int block, int lane, const Surfaces& s, Batch& next) const;

  const Looks& looks_;
  const Objects& objects_;
};

/// Adds the colours of the lights that are seen.
void add_light(const ShadowBlock& shadow, Block& block);

}  // namespace plumb::bench
