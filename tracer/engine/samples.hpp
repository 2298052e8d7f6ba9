// The places of a pixel's samples.
#pragma once

#include <vector>

#include "tracer/scene/render_job.hpp"

namespace plumb::engine {

/// Shares of a pixel from its left and its top edge, 0 < x, y < 1.
struct SamplePoint {
  double x, y;
};

/// Returns the places. Throws std::invalid_argument when the pattern has no such number of samples.
std::vector<SamplePoint> sample_points(int samples, SamplePattern pattern);

}  // namespace plumb::engine
