// Renders a whole picture with the textbook tracer.
#pragma once

#include <functional>
#include <string>

#include "tracer/image/image.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::textbook {

enum class RealType { float32, float64, long_double };

struct RenderJob {
  int width = 480;
  int height = 320;
  RenderOptions options;
  RealType real = RealType::float64;
  int threads = 0;  ///< 0: as many as the machine runs at once
  /// Called now and then, from one thread at a time, with the fraction that is done; may be empty.
  std::function<void(double)> progress;
};

/// Linear colours, one sample through each pixel centre; the same for every number of threads. Expects a
/// scene as read_scene returns it without errors. Throws std::runtime_error on a scene that cannot be traced.
Image render(const Scene& scene, const Camera& camera, const RenderJob& job);

}  // namespace plumb::textbook
