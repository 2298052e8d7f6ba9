// Rays side by side, as vectors load them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "tracer/engine/compiled_scene.hpp"

namespace plumb::engine {

/// Number of rays of a tile, and of every level of the recursion. It is a power of two, so that a tile is a
/// square.
inline constexpr std::size_t stream_size = 256;
/// Number of lanes that vectors may read beyond the last ray.
inline constexpr std::size_t widest_vector = 16;

template <class T>
using Lanes = std::array<T, stream_size + widest_vector>;

/// An integer as wide as the real type, so that masks fit both.
template <class Real>
using Word = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;

template <class Real>
struct alignas(64) Lanes3 {
  Lanes<Real> x, y, z;
};

/// Rays of unit direction, where they start, and what they meet first.
template <class Real>
struct Rays {
  Lanes3<Real> origin, direction, per_direction;  ///< the last is 1 / direction, for rays that meet boxes
  Lanes<Real> t_min;                              ///< by rounding, a hit up to this t is the start
  Lanes<Real> t;                                  ///< of the nearest hit, or infinity
  Lanes<Word<Real>> ref, face;                    ///< what was hit; 0 for nothing
  Lanes<Word<Real>> start, start_face;            ///< the surface that the ray leaves; 0 for none
  Lanes<std::uint64_t> instance, start_instance;  ///< numbers of hit and start in the world
};

/// One level of the recursion: its rays, and what shading adds to them.
template <class Real>
struct Level {
  Rays<Real> rays;
  std::size_t size = 0;
  Lanes3<Real> point, normal, colour;
  Lanes<std::uint32_t> material;
  Lanes<bool> is_of_one;  ///< at the first lane of a vector: true if all its lanes have one material
  // How the colour enters that of the ray that sent this one out.
  Lanes<std::uint32_t> parent;
  Lanes3<Real> weight;
  Lanes<std::uint16_t> depth, unbent;
  Lanes<std::int32_t> interior;  ///< the stack of media around, see Interiors
};

/// Rays to one light. t is its distance; it is negative when there is nothing to ask, or once the light is
/// hidden.
template <class Real>
struct ShadowRays {
  Rays<Real> rays;
  Lanes<Real> cos_theta;
};

}  // namespace plumb::engine
