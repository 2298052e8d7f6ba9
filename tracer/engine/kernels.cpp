#include "tracer/engine/kernels.hpp"

#undef HWY_TARGET_INCLUDE
// Left out, because widest_vectors() never chooses them.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#define HWY_TARGET_INCLUDE "tracer/engine/kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "tracer/engine/shade-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace plumb::engine::HWY_NAMESPACE {

template <class Real>
std::unique_ptr<TileRenderer<Real>> make(const CompiledScene<Real>& scene, const View<Real>& view) {
  return std::make_unique<Shader<Real>>(scene, view);
}
template std::unique_ptr<TileRenderer<float>> make(const CompiledScene<float>&, const View<float>&);
template std::unique_ptr<TileRenderer<double>> make(const CompiledScene<double>&, const View<double>&);

}  // namespace plumb::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plumb::engine {

template <class Real>
std::unique_ptr<TileRenderer<Real>> make_tile_renderer(const CompiledScene<Real>& scene,
                                                       const View<Real>& view, Vectors vectors) {
  switch (vectors) {
    case Vectors::avx512:
      return N_AVX3::make(scene, view);
    case Vectors::avx2:
      return N_AVX2::make(scene, view);
    case Vectors::any:
      break;
  }
  return HWY_STATIC_DISPATCH(make)(scene, view);
}
template std::unique_ptr<TileRenderer<float>> make_tile_renderer(const CompiledScene<float>&,
                                                                 const View<float>&, Vectors);
template std::unique_ptr<TileRenderer<double>> make_tile_renderer(const CompiledScene<double>&,
                                                                  const View<double>&, Vectors);

}  // namespace plumb::engine
#endif
