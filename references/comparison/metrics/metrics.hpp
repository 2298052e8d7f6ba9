// Figures about the difference of two pictures, beside those that decide
// (references/comparison/comparison.hpp).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "references/comparison/metrics/flip.hpp"
#include "references/comparison/metrics/picture.hpp"

namespace plumb::comparison {

/// The percentiles that are reported, in thousandths.
inline constexpr std::array<std::size_t, 4> permilles{500, 900, 990, 999};

/// A metric that is one number of two whole pictures.
struct ScalarMetric {
  const char* key;   ///< in JSON
  const char* name;  ///< in text, at most 12 letters
  const char* what;  ///< the name and its source, for --help
  const char* none;  ///< why pictures may have none, beside pixels that are not finite
  std::optional<double> (*of)(const PictureView& reference, const PictureView& test, double peak);
};
const std::vector<ScalarMetric>& scalar_metrics();

/// A pixel with a component that is not finite, on either side, enters none of them (the comparison counts
/// it).
struct Metrics {
  double peak = 1;  ///< largest |component| on either side, at least 1, as OpenImageIO's idiff takes it
  std::optional<double> psnr_db;  ///< 20 log10(peak / RMS error); nothing when nothing differs
  /// Of the largest difference of each pixel's components: the smallest that this share of the pixels does
  /// not exceed (nearest rank).
  std::array<double, permilles.size()> percentiles{};
  std::vector<double> bias;  ///< per channel, the mean of test - reference
  // Costly ones; nothing unless asked for, and when a pixel is not finite.
  std::vector<std::optional<double>> scalars =
      std::vector<std::optional<double>>(scalar_metrics().size());  ///< by scalar_metrics()
  std::optional<Flip> flip;  ///< references/comparison/metrics/flip.hpp
};

/// All but the costly ones. Pictures of one size and channel count.
Metrics cheap_metrics(const PictureView& reference, const PictureView& test);

/// All. Those that are one number take `peak` for their dynamic range.
Metrics all_metrics(const PictureView& reference, const PictureView& test, ColourSpace space);

}  // namespace plumb::comparison
