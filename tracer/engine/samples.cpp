#include "tracer/engine/samples.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace plumb::engine {
namespace {

/// Returns the binary digits of i, mirrored at the point (van der Corput, 1935).
double radical_inverse(unsigned i) {
  double inverse = 0;
  for (double digit = 0.5; i != 0; i >>= 1, digit *= 0.5) inverse += (i & 1) != 0 ? digit : 0;
  return inverse;
}

std::vector<SamplePoint> grid(int samples) {
  const int edge = static_cast<int>(std::lround(std::sqrt(samples)));
  if (edge * edge != samples) {
    throw std::invalid_argument("found " + std::to_string(samples) +
                                " samples in a grid, expected a square like " + std::to_string(edge * edge) +
                                "; or take the pattern low-discrepancy");
  }
  std::vector<SamplePoint> points;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) points.push_back({(x + 0.5) / edge, (y + 0.5) / edge});
  }
  return points;
}

}  // namespace

std::vector<SamplePoint> sample_points(int samples, SamplePattern pattern) {
  if (samples < 1) throw std::invalid_argument("found no samples, expected at least 1");
  if (pattern == SamplePattern::grid) return grid(samples);
  // The second coordinate is moved to the middle of its gap, so that one sample is the pixel's centre.
  double gap = 1;
  while (gap * samples > 1) gap /= 2;
  std::vector<SamplePoint> points;
  for (int i = 0; i < samples; ++i)
    points.push_back({(i + 0.5) / samples, radical_inverse(static_cast<unsigned>(i)) + gap / 2});
  return points;
}

}  // namespace plumb::engine
