// How a tracer is to make a picture: size, options, samples, real type, threads.
#pragma once

#include <functional>

#include "tracer/scene/render_options.hpp"

namespace plumb {

/// The real type to compute in; `quad` has 113 significant bits, the most.
enum class RealType { float32, float64, long_double, quad };

/// Where the samples of a pixel lie.
enum class SamplePattern {
  grid,             ///< the pixel centres of a picture that is n times as large, for n * n samples
  low_discrepancy,  ///< Hammersley's points (Hammersley, "Monte Carlo Methods for Solving Multivariable
                    ///< Problems", 1960), any number
};

struct RenderJob {
  int width = 480;
  int height = 320;
  RenderOptions options;
  int samples = 1;  ///< per pixel, averaged; a single one is the pixel's centre, in both patterns
  SamplePattern pattern = SamplePattern::grid;
  RealType real = RealType::float64;
  int threads = 0;  ///< 0: as many as the machine runs at once
  /// Called now and then, by one thread at a time, with the fraction that is done (0 to 1). May be empty.
  std::function<void(double)> progress;
};

}  // namespace plumb
