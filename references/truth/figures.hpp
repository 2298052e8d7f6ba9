// How far a picture is from what is right, as far as that was measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "references/comparison/comparison.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::truth {

/// Returns the largest difference of a component, relative above 1, as plumb verify judges it; infinite when
/// a component is not finite.
inline double error_of_pixel(const Rgbd& right, const Image& image, const PixelPlace& place) {
  double error = 0;
  for (int k = 0; k < 3; ++k) {
    const auto found = static_cast<double>(image.pixel(place.x, place.y)[k]);
    const double off = std::abs(found - right[k]) / std::max(1.0, std::abs(right[k]));
    if (!std::isfinite(off)) return std::numeric_limits<double>::infinity();
    error = std::max(error, off);
  }
  return error;
}

/// Errors of one picture. `against_double` covers all pixels, and is missing where double is no yardstick.
struct ErrorFigures {
  double against_oracle = 0;
  std::optional<double> against_double;

  double largest() const { return std::max(against_oracle, against_double.value_or(0)); }
};

}  // namespace plumb::truth
