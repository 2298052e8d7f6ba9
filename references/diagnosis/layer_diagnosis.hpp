// Finds what is wrong with a tracer from its own picture of the normals, or of the depths.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"
#include "tracer/scene/shot.hpp"
#include "tracer/textbook/layers.hpp"

namespace plumb::diagnosis {

enum class LayerVerdict { right, faults, unexplained };

struct LayerFault {
  const faults::Fault* fault;
  std::vector<const faults::Fault*> alike;  ///< at most two, the commonest, which give the same layer here
};

struct LayerDiagnosis {
  LayerVerdict verdict = LayerVerdict::unexplained;
  std::vector<LayerFault> faults;  ///< one or two
  std::string encoding;            ///< how the layer is written, in words; empty when it is unexplained
  std::size_t pixels = 0;          ///< number that were looked at, spread over the picture
  std::size_t explained = 0;       ///< number of those
};

/// Returns what is wrong with a layer `normal` or `depth` of the shot's size. A fault is named only if 99 of
/// 100 pixels are as a tracer with it would have them, and at most half as many are not as without it. Throws
/// std::invalid_argument for another layer, and std::runtime_error when the scene cannot be traced.
LayerDiagnosis diagnose_layer(const Shot& shot, const ImageFile& seen, textbook::Layer layer);

}  // namespace plumb::diagnosis
