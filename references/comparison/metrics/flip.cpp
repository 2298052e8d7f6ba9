#include "references/comparison/metrics/flip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "references/comparison/metrics/flip_kernels.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::comparison {
namespace {

/// Returns a finite luminance: the sum of the weights may be rounded above 1.
float luminance(const float* pixel, int channels) {
  if (channels < 3) return pixel[0];
  constexpr float most = std::numeric_limits<float>::max();
  return std::clamp(0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2], -most, most);
}

/// The light that the tone curve maps to 0.85: the positive root of (a0 - 0.85 b0) x^2 + (a1 - 0.85 b1) x -
/// 0.85 b2.
double light_of_0_85() {
  constexpr double t = 0.85;
  constexpr double square = 0.36 * (2.51 - t * 2.43);
  constexpr double half = 0.5 * 0.6 * (0.03 - t * 0.59) / square;
  return -half + std::sqrt(half * half + t * 0.14 / square);
}

/// Like numpy's percentile: returns the mean of the two in the middle of an even number of values. Reorders
/// them.
double median(std::vector<float>& values) {
  const std::size_t middle = values.size() / 2;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(middle);
  std::nth_element(values.begin(), at, values.end());
  if (values.size() % 2 == 1) return *at;
  return (static_cast<double>(*at) + *std::max_element(values.begin(), at)) / 2;
}

void raise_errors_of(const flip_kernels::Opponent& reference, const flip_kernels::Opponent& test,
                     float* errors) {
  const std::size_t bands = std::min(static_cast<std::size_t>(processors()), reference.height);
  in_parallel(bands, processors(), [&](std::size_t i) {
    flip_kernels::raise_errors(reference, test, i * reference.height / bands,
                               (i + 1) * reference.height / bands, errors);
  });
}

}  // namespace

Exposures flip_exposures(const PictureView& reference) {
  std::vector<float> values(reference.pixels());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = luminance(reference.pixel(i), reference.channels);
  const double largest = *std::max_element(values.begin(), values.end());
  constexpr double least = std::numeric_limits<float>::epsilon();
  if (!(largest > least)) return {};
  const double light = light_of_0_85();
  const double middle = std::max(median(values), least);
  Exposures exposures{std::log2(light / largest), std::log2(light / middle), 0};
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

std::vector<float> flip_map(const PictureView& reference, const PictureView& test, ColourSpace space) {
  const Exposures exposures = space == ColourSpace::linear ? flip_exposures(reference) : Exposures{};
  std::vector<float> errors(reference.pixels());
  const double step = (exposures.stop - exposures.start) / std::max(exposures.count - 1, 1);
  for (int i = 0; i < exposures.count; ++i) {
    const auto factor = static_cast<float>(std::exp2(exposures.start + i * step));
    raise_errors_of(flip_kernels::to_opponent(reference, space, factor),
                    flip_kernels::to_opponent(test, space, factor), errors.data());
  }
  return errors;
}

Flip flip(const PictureView& reference, const PictureView& test, ColourSpace space) {
  const std::vector<float> errors = flip_map(reference, test, space);
  Flip result;
  result.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  result.max = *std::max_element(errors.begin(), errors.end());
  if (space == ColourSpace::linear) result.exposures = flip_exposures(reference);
  return result;
}

}  // namespace plumb::comparison
