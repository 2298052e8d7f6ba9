// How far a component of a picture may be from that of its reference.
#pragma once

#include <algorithm>
#include <cmath>

namespace plumb::comparison {

/// A component agrees when it differs by at most at(reference). Values that are not finite never agree.
struct Limit {
  double tolerance;     ///< relative above 1 only
  double relative = 0;  ///< relative everywhere; counts where it allows more

  /// A plain number is a tolerance.
  Limit(double tolerance_, double relative_ = 0) : tolerance(tolerance_), relative(relative_) {}

  double at(double reference) const {
    const double size = std::abs(reference);
    return std::max(tolerance * std::max(1.0, size), relative * size);
  }
  /// True if `relative` allows more than the tolerance anywhere.
  bool is_relative() const { return relative > tolerance; }
};

}  // namespace plumb::comparison
