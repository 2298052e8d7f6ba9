#include "references/comparison/metrics/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "references/comparison/metrics/ssim.hpp"

namespace plumb::comparison {
namespace {

/// Sums over the pixels that are finite on both sides.
struct Sums {
  std::vector<double> worst;  // of each pixel's components
  std::vector<double> signed_sum;
  double squares = 0;
  double peak = 1;
};

bool is_finite(const float* pixel, int channels) {
  return std::all_of(pixel, pixel + channels, [](float v) { return std::isfinite(v); });
}

void add(Sums& sums, const float* r, const float* t) {
  double worst = 0;
  for (std::size_t c = 0; c < sums.signed_sum.size(); ++c) {
    const double difference = static_cast<double>(t[c]) - static_cast<double>(r[c]);
    sums.signed_sum[c] += difference;
    sums.squares += difference * difference;
    worst = std::max(worst, std::abs(difference));
    sums.peak = std::max<double>(sums.peak, std::max(std::abs(r[c]), std::abs(t[c])));
  }
  sums.worst.push_back(worst);
}

Sums sums_of(const PictureView& reference, const PictureView& test) {
  Sums sums;
  sums.worst.reserve(reference.pixels());
  sums.signed_sum.resize(static_cast<std::size_t>(reference.channels));
  for (std::size_t i = 0; i < reference.pixels(); ++i) {
    const float* const r = reference.pixel(i);
    const float* const t = test.pixel(i);
    if (is_finite(r, reference.channels) && is_finite(t, reference.channels)) add(sums, r, t);
  }
  return sums;
}

/// Reorders the values; there is at least one.
double percentile(std::vector<double>& values, std::size_t permille) {
  const std::size_t rank = (values.size() * permille + 999) / 1000;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

const std::vector<ScalarMetric>& scalar_metrics() {
  static const std::vector<ScalarMetric> all{
      {"ssim", "SSIM", "SSIM (Wang et al. 2004, luminance)", "smaller than 11 x 11", &ssim},
  };
  return all;
}

Metrics cheap_metrics(const PictureView& reference, const PictureView& test) {
  Sums sums = sums_of(reference, test);
  Metrics metrics;
  metrics.peak = sums.peak;
  metrics.bias = sums.signed_sum;
  if (sums.worst.empty()) return metrics;
  const auto finite = static_cast<double>(sums.worst.size());
  for (double& bias : metrics.bias) bias /= finite;
  const double rms = std::sqrt(sums.squares / (finite * reference.channels));
  if (rms > 0) metrics.psnr_db = 20 * std::log10(sums.peak / rms);
  for (std::size_t i = 0; i < permilles.size(); ++i)
    metrics.percentiles[i] = percentile(sums.worst, permilles[i]);
  return metrics;
}

Metrics all_metrics(const PictureView& reference, const PictureView& test, ColourSpace space) {
  Metrics metrics = cheap_metrics(reference, test);
  const auto every_finite = [](const PictureView& p) {
    return std::all_of(p.values, p.values + p.components(), [](float v) { return std::isfinite(v); });
  };
  if (!every_finite(reference) || !every_finite(test)) return metrics;
  for (std::size_t i = 0; i < metrics.scalars.size(); ++i)
    metrics.scalars[i] = scalar_metrics()[i].of(reference, test, metrics.peak);
  metrics.flip = flip(reference, test, space);
  return metrics;
}

}  // namespace plumb::comparison
