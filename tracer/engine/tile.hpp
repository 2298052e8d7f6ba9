// What rendering a tile needs. The functions that render one exist once per instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracer/engine/compiled_scene.hpp"
#include "tracer/engine/samples.hpp"
#include "tracer/engine/statistics.hpp"
#include "tracer/scene/dielectrics.hpp"
#include "tracer/scene/render_options.hpp"

namespace plumb::engine {

inline constexpr int tile_edge = 16;
inline constexpr std::size_t pixels_of_tile = std::size_t{tile_edge} * tile_edge;

/// The camera in the engine's real type: the direction of a pixel is right * x + up * y + forward.
template <class Real>
struct View {
  Vec3<Real> eye, right, up, forward;
  int width, height;  ///< of the picture
  std::vector<SamplePoint> samples;
  DielectricsAroundEye<Real> around_the_eye;
  RenderOptions options;
};

/// The pixels from x to x + width and from y to y + height, at most tile_edge each way.
struct Tile {
  int x, y, width, height;
};

/// A place within a tile.
struct TilePixel {
  std::uint8_t x, y;
};

/// The pixels of a complete tile along Morton's curve: every 8, 16 or 64 in a row are a block of the picture.
inline constexpr std::array<TilePixel, pixels_of_tile> tile_pixels = [] {
  constexpr auto even_bits = [](unsigned i) {
    return static_cast<std::uint8_t>((i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8));
  };
  std::array<TilePixel, pixels_of_tile> pixels{};
  for (unsigned i = 0; i < pixels.size(); ++i) pixels[i] = {even_bits(i), even_bits(i >> 1)};
  return pixels;
}();

/// Renders tiles, one after the other, on one thread.
template <class Real>
class TileRenderer {
 public:
  virtual ~TileRenderer() = default;
  TileRenderer() = default;
  TileRenderer(const TileRenderer&) = delete;
  TileRenderer& operator=(const TileRenderer&) = delete;

  /// Writes the tile's linear colours to `rgb`: r g b interleaved, row by row of the tile.
  virtual void render(const Tile& tile, float* rgb) = 0;
  virtual const Statistics& statistics() const = 0;
};

}  // namespace plumb::engine
