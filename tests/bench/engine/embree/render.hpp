// Renders a picture with Embree in one of its modes.
#pragma once

#include "tests/bench/engine/embree/modes.hpp"
#include "tests/bench/engine/embree/objects.hpp"
#include "tracer/image/image.hpp"

namespace plumb::bench {

struct EmbreeJob {
  Mode mode = Mode::packet16;
  int width = 640;
  int height = 480;
  int depth = 8;
  int threads = 1;
  int tile = 16;  ///< edge in pixels, a multiple of 4
};

/// Throws std::runtime_error when the eye is inside glass.
Image render(const EmbreeScene& embree, const Scene& scene, const EmbreeJob& job);

}  // namespace plumb::bench
