// Rays side by side, as vectors read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "tracer/engine/compiled_scene.hpp"

namespace plumb::engine {

/// Rays of a tile, and of every level of the recursion: a power of two, so that a tile is a square.
inline constexpr std::size_t stream_size = 256;
/// Vectors may read beyond the last ray.
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
  Lanes3<Real> origin, direction, per_direction;  ///< the last, 1 / direction, for whom meets a box
  Lanes<Real> t_min;                              ///< hits up to here are the start, by rounding
  Lanes<Real> t;                                  ///< of the nearest hit, or infinity
  Lanes<Word<Real>> ref, face;                    ///< what was hit; 0 for nothing
  Lanes<Word<Real>> start, start_face;            ///< the surface that the ray leaves; 0 for none
  Lanes<std::uint64_t> instance, start_instance;  ///< of hit and start, counted in the world
};

/// What shading adds: one level of the recursion.
template <class Real>
struct Level {
  Rays<Real> rays;
  std::size_t size = 0;
  Lanes3<Real> point, normal, colour;
  Lanes<std::uint32_t> material;
  Lanes<bool> is_of_one;  ///< at the first lane of a vector: whether all have one material
  // How the colour goes into the one of the ray that sent this one out.
  Lanes<std::uint32_t> parent;
  Lanes3<Real> weight;
  Lanes<std::uint16_t> depth, unbent;
  Lanes<std::int32_t> interior;  ///< the media around: see Interiors
};

/// Rays to one light: t is its distance, or negative when there is nothing to ask, or when it is hidden.
template <class Real>
struct ShadowRays {
  Rays<Real> rays;
  Lanes<Real> cos_theta;
};

}  // namespace plumb::engine
