#include "references/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumb::references {
namespace {

double allowed(double reference, double tolerance) { return tolerance * std::max(1.0, std::abs(reference)); }

/// What the components of one pixel say together.
struct PixelError {
  bool is_finite = true;
  bool is_over = false;
  double worst = 0;  // in units of what is allowed at tolerance 1
};

PixelError pixel_error(const float* reference, const float* test, int channels, double tolerance) {
  PixelError error;
  for (int c = 0; c < channels; ++c) {
    if (!std::isfinite(reference[c]) || !std::isfinite(test[c])) return {false, true, INFINITY};
    const double difference = std::abs(static_cast<double>(test[c]) - static_cast<double>(reference[c]));
    error.is_over = error.is_over || difference > allowed(reference[c], tolerance);
    error.worst = std::max(error.worst, difference / allowed(reference[c], 1));
  }
  return error;
}

PixelPair pair_at(std::size_t pixel, int width, int channels, const float* reference, const float* test) {
  const auto w = static_cast<std::size_t>(width);
  return {static_cast<int>(pixel % w), static_cast<int>(pixel / w), std::vector<float>(test, test + channels),
          std::vector<float>(reference, reference + channels)};
}

}  // namespace

Comparison compare(int width, int height, int channels, const std::vector<float>& reference,
                   const std::vector<float>& test, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw std::invalid_argument("expected a finite tolerance >= 0");
  Comparison result;
  result.pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto step = static_cast<std::size_t>(channels);
  if (reference.size() != result.pixels * step || test.size() != reference.size()) {
    throw std::invalid_argument("the pictures do not have " + std::to_string(width) + " x " +
                                std::to_string(height) + " pixels of " + std::to_string(channels) +
                                " channels");
  }
  double worst = -1;
  double sum = 0;
  double sum_of_squares = 0;
  for (std::size_t pixel = 0; pixel < result.pixels; ++pixel) {
    const float* const r = reference.data() + pixel * step;
    const float* const t = test.data() + pixel * step;
    const PixelError error = pixel_error(r, t, channels, tolerance);
    result.pixels_over += error.is_over ? 1 : 0;
    if (error.worst > worst) {
      worst = error.worst;
      result.worst = pair_at(pixel, width, channels, r, t);
    }
    if (!error.is_finite) {
      ++result.non_finite;
      continue;
    }
    result.judged_error = std::max(result.judged_error, error.worst);
    for (std::size_t c = 0; c < step; ++c) {
      const double difference = std::abs(static_cast<double>(t[c]) - static_cast<double>(r[c]));
      result.max_error = std::max(result.max_error, difference);
      sum += difference;
      sum_of_squares += difference * difference;
    }
  }
  const auto finite = static_cast<double>((result.pixels - result.non_finite) * step);
  if (finite > 0) {
    result.mean_error = sum / finite;
    result.rms_error = std::sqrt(sum_of_squares / finite);
  }
  return result;
}

Comparison compare(const Image& reference, const Image& test, double tolerance) {
  if (reference.width != test.width || reference.height != test.height) {
    throw std::invalid_argument("the pictures have different sizes: reference " +
                                std::to_string(reference.width) + " x " + std::to_string(reference.height) +
                                ", test " + std::to_string(test.width) + " x " + std::to_string(test.height));
  }
  return compare(test.width, test.height, 3, reference.rgb, test.rgb, tolerance);
}

bool is_within(const float* reference, const float* test, double tolerance) {
  return !pixel_error(reference, test, 3, tolerance).is_over;
}

std::vector<PixelPlace> pixels_over(const Image& reference, const Image& test, double tolerance) {
  std::vector<PixelPlace> places;
  for (int y = 0; y < test.height; ++y) {
    for (int x = 0; x < test.width; ++x) {
      if (!is_within(reference.pixel(x, y), test.pixel(x, y), tolerance)) places.push_back({x, y});
    }
  }
  return places;
}

}  // namespace plumb::references
