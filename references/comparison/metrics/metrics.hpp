// Figures about the difference of two pictures, beside those that decide
// (references/comparison/comparison.hpp).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "references/comparison/metrics/flip.hpp"
#include "references/comparison/metrics/picture.hpp"

namespace plumb::references {

/// The percentiles that are told, in thousandths.
inline constexpr std::array<std::size_t, 4> permilles{500, 900, 990, 999};

/// A pixel with a component that is not finite, on either side, enters none of them (the comparison counts
/// it).
struct Metrics {
  double peak =
      1;  ///< the largest |component| on either side, at least 1: what OpenImageIO's idiff takes, too
  std::optional<double> psnr_db;  ///< 20 log10(peak / RMS error); nothing when nothing differs
  /// Of the largest difference of each pixel's components: the smallest that is not exceeded by that many
  /// percent of the pixels (nearest rank).
  std::array<double, permilles.size()> percentiles{};
  std::vector<double> bias;  ///< per channel, the mean of test - reference
  // Costly ones; nothing unless asked for, and when a pixel is not finite.
  std::optional<double> ssim;  ///< references/comparison/metrics/ssim.hpp
  std::optional<Flip> flip;    ///< references/comparison/metrics/flip.hpp
};

/// All but SSIM and FLIP. Pictures of one size and channel count.
Metrics cheap_metrics(const PictureView& reference, const PictureView& test);

/// All. SSIM takes `peak` for its dynamic range.
Metrics all_metrics(const PictureView& reference, const PictureView& test, ColourSpace space);

}  // namespace plumb::references
