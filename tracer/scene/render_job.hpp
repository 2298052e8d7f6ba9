// A picture that is asked of a tracer.
#pragma once

#include <functional>

#include "tracer/scene/render_options.hpp"

namespace plumb {

/// `quad` has 113 bits, the most.
enum class RealType { float32, float64, long_double, quad };

/// Where in a pixel its samples lie.
enum class SamplePattern {
  grid,             ///< the pixel centres of a picture that is n times as large, for n * n samples
  low_discrepancy,  ///< Hammersley's points (Hammersley, "Monte Carlo Methods for Solving Multivariable
                    ///< Problems", 1960), any number
};

struct RenderJob {
  int width = 480;
  int height = 320;
  RenderOptions options;
  int samples = 1;  ///< of a pixel, averaged; one is the pixel's centre, in both patterns
  SamplePattern pattern = SamplePattern::grid;
  RealType real = RealType::float64;
  int threads = 0;  ///< 0: as many as the machine runs at once
  /// Called now and then, from one thread at a time, with the fraction that is done; may be empty.
  std::function<void(double)> progress;
};

}  // namespace plumb
