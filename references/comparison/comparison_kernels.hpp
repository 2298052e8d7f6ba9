// The inner loop of the comparison, compiled for every instruction set that the processor may have.
#pragma once

#include <cstddef>
#include <limits>

#include "references/comparison/limit.hpp"

namespace plumb::comparison::comparison_kernels {

/// What was seen so far. Names are those of Comparison.
struct Tally {
  std::size_t non_finite = 0;
  std::size_t pixels_over = 0;
  double max_error = 0;
  double judged_error = 0;
  double sum = 0;
  double sum_of_squares = 0;
  /// In units of what tolerance 1 allows. Under a relative limit it is what exceeds the limit, in the same
  /// units. Infinite when not finite.
  double worst = -std::numeric_limits<double>::infinity();
  std::size_t worst_pixel = 0;
};

/// Adds `pixels` pixels, the first of which has the number `first`. The floats need no alignment. Sums are in
/// double. Which pixels are over is decided exactly as by is_within().
void add(Tally& tally, const std::byte* reference, const std::byte* test, std::size_t pixels, int channels,
         const Limit& limit, std::size_t first);

}  // namespace plumb::comparison::comparison_kernels
