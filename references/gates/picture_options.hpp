// How scenes are read, rendered on our side and compared, whatever they are compared with.
#pragma once

#include <optional>
#include <string>

#include "references/renderers/ours.hpp"
#include "tracer/format/dialect.hpp"
#include "tracer/scene/render_job.hpp"

namespace plumb::references {

struct Size {
  int width;
  int height;
};

struct PictureOptions {
  std::optional<Size> size;  ///< instead of the scenes' own
  std::string camera;        ///< instead of the scenes' own, when not empty
  double tolerance = 1e-6;
  Dialect dialect;
  std::string dialect_name{};  ///< as it was asked for; empty when it was not
  RenderOptions render;
  RealType real = RealType::float64;
  Renderer renderer = Renderer::engine;  ///< of our side
  bool keeps_pictures = false;           ///< in the results while they are reported, for a report
};

}  // namespace plumb::references
