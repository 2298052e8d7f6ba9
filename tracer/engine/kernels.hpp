// Makes the tile renderers of one scene, for one instruction set.
#pragma once

#include <memory>

#include "tracer/engine/tile.hpp"
#include "tracer/system/vectors.hpp"

namespace plumb::engine {

/// Makes a renderer for one thread. Scene and view must outlive it.
template <class Real>
std::unique_ptr<TileRenderer<Real>> make_tile_renderer(const CompiledScene<Real>& scene,
                                                       const View<Real>& view, Vectors vectors);

extern template std::unique_ptr<TileRenderer<float>> make_tile_renderer(const CompiledScene<float>&,
                                                                        const View<float>&, Vectors);
extern template std::unique_ptr<TileRenderer<double>> make_tile_renderer(const CompiledScene<double>&,
                                                                         const View<double>&, Vectors);

}  // namespace plumb::engine
