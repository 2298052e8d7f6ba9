// Rays in blocks of sixteen, as arrays of floats: what Embree's packets take and what the compiler
// vectorises.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>

namespace plumb::bench {

inline constexpr int lanes = 16;
inline constexpr float no_limit = 1e30F;  ///< t_max of a ray that ends nowhere; -ffast-math knows no infinity

/// A lane without a ray has t_max < t_min, which Embree skips.
inline constexpr float no_ray = -1;

/// The transmissive objects that a ray is inside of, as in tracer/textbook/interiors.hpp; deeper nesting
/// throws.
struct Media {
  static constexpr int most = 6;
  int count = 0;
  std::uint64_t object[most];
  float eta[most];

  float top_eta() const { return count == 0 ? 1 : eta[count - 1]; }

  float cross(std::uint64_t id, float new_eta) {
    int at = count;
    while (at > 0 && object[at - 1] != id) --at;
    if (at == 0) {
      if (count == most) throw std::runtime_error("glass is nested deeper than 6");
      const float outside = top_eta();
      object[count] = id;
      eta[count++] = new_eta;
      return outside / new_eta;
    }
    const bool was_top = at == count;
    for (int i = at; i < count; ++i) object[i - 1] = object[i], eta[i - 1] = eta[i];
    --count;
    return was_top ? new_eta / top_eta() : 1;
  }
};

struct alignas(64) Block {
  RTCRayHit16 ray;
  float weight[3][lanes];  ///< of what the ray sees, in its pixel
  float colour[3][lanes];  ///< what was found at its hit, weighted
  std::int32_t pixel[lanes];
};

struct alignas(64) ShadowBlock {
  RTCRay16 ray;
  float colour[3][lanes];  ///< added to the block's colour when the light is seen
};

/// Rays of one recursion depth.
struct Batch {
  explicit Batch(int rays) : blocks(std::make_unique<Block[]>(static_cast<std::size_t>(rays / lanes + 1))) {}

  std::unique_ptr<Block[]> blocks;
  std::unique_ptr<Media[]> media;  ///< by ray; null where the scene has no glass
  int count = 0;                   ///< of rays

  int block_count() const { return (count + lanes - 1) / lanes; }
  /// Marks the lanes past the last ray, and fills them with numbers.
  void close() {
    for (int i = count; i < block_count() * lanes; ++i) {
      Block& block = blocks[static_cast<std::size_t>(i / lanes)];
      RTCRay16& ray = block.ray.ray;
      const int lane = i % lanes;
      ray.org_x[lane] = ray.org_x[0], ray.org_y[lane] = ray.org_y[0], ray.org_z[lane] = ray.org_z[0];
      ray.dir_x[lane] = ray.dir_x[0], ray.dir_y[lane] = ray.dir_y[0], ray.dir_z[lane] = ray.dir_z[0];
      ray.tnear[lane] = 0, ray.tfar[lane] = no_ray;
      ray.time[lane] = 0, ray.mask[lane] = ~0U, ray.id[lane] = 0, ray.flags[lane] = 0;
      block.ray.hit.geomID[lane] = block.ray.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
      block.pixel[lane] = -1;
    }
  }
};

}  // namespace plumb::bench
