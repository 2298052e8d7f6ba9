// A picture that is asked of a tracer.
#pragma once

#include <functional>

#include "tracer/scene/render_options.hpp"

namespace plumb {

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

}  // namespace plumb
