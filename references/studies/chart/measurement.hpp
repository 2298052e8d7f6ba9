// What was measured of one configuration. A file keeps it until the chart is complete.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "references/studies/chart/cost.hpp"

namespace plumb::studies {

/// Absolute differences of linear components, as in Comparison.
struct ChartError {
  double max = 0;
  double rms = 0;
  std::size_t pixels_over = 0;  ///< 1e-6, relative above 1; includes those that are not finite
  std::size_t non_finite = 0;   ///< number of pixels
};

struct MeasuredRun {
  WorkCost cost;
  double yardstick_seconds = 0;  ///< CPU time of the yardstick, measured just before
};

struct Measurement {
  std::optional<ChartError> error;
  std::vector<MeasuredRun> runs;

  double seconds() const;  ///< CPU time of all runs
};

/// Returns nothing measured when there is no such file, or a damaged one.
Measurement load_measurement(const std::string& path);

/// Throws std::runtime_error when the file cannot be written.
void store_measurement(const std::string& path, const Measurement& measurement);

}  // namespace plumb::studies
