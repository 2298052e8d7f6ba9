#include "references/comparison/comparison_exact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::comparison {
namespace {

using comparison_kernels::Tally;

bool is_whole(const PixelRows& rows, std::size_t channel) {
  return channel < rows.contents.are_whole.size() && rows.contents.are_whole[channel];
}

struct Component {
  double scale;  ///< what 1 of the tolerance means for it
  double allowed;
};

Component component(double reference, bool is_exact, Limit limit) {
  if (!is_exact) return {std::max(1.0, std::abs(reference)), limit.at(reference)};
  return {1, std::max(limit.tolerance, limit.relative * std::abs(reference))};
}

void add_pixel(Tally& tally, const double* reference, const double* test, const std::vector<bool>& are_exact,
               Limit limit, std::size_t number) {
  bool is_finite = true, is_over = false;
  double worst = -std::numeric_limits<double>::infinity(), judged = 0, largest = 0, sum = 0, squares = 0;
  for (std::size_t c = 0; c < are_exact.size(); ++c) {
    is_finite = is_finite && std::isfinite(reference[c]) && std::isfinite(test[c]);
    const Component of = component(reference[c], are_exact[c], limit);
    const double difference = std::abs(test[c] - reference[c]);
    is_over = is_over || !(difference <= of.allowed);
    judged = std::max(judged, difference / of.scale);
    worst = std::max(worst, (limit.is_relative() ? difference - of.allowed : difference) / of.scale);
    largest = std::max(largest, difference);
    sum += difference;
    squares += difference * difference;
  }
  if (!is_finite) worst = std::numeric_limits<double>::infinity();
  if (worst > tally.worst) {
    tally.worst = worst;
    tally.worst_pixel = number;
  }
  tally.pixels_over += is_over || !is_finite ? 1 : 0;
  tally.non_finite += is_finite ? 0 : 1;
  if (!is_finite) return;
  tally.judged_error = std::max(tally.judged_error, judged);
  tally.max_error = std::max(tally.max_error, largest);
  tally.sum += sum;
  tally.sum_of_squares += squares;
}

}  // namespace

bool needs_doubles(const PixelRows& reference, const PixelRows& test) {
  return reference.is_double || test.is_double || !reference.contents.are_whole.empty() ||
         !test.contents.are_whole.empty();
}

void add_exactly(Tally& tally, const PixelRows& reference, const PixelRows& test, Limit limit,
                 const PixelMask& mask) {
  const auto channels = static_cast<std::size_t>(reference.channels);
  std::vector<bool> are_exact;
  for (std::size_t c = 0; c < channels; ++c) are_exact.push_back(is_whole(reference, c) && is_whole(test, c));
  std::vector<double> r(reference.row_values()), t(r.size());
  std::size_t number = 0;
  for (int y = 0; y < reference.height; ++y) {
    reference.copy_row(y, r.data());
    test.copy_row(y, t.data());
    for (int x = 0; x < reference.width; ++x, ++number) {
      const std::size_t at = static_cast<std::size_t>(x) * channels;
      if (mask.has(x, y)) add_pixel(tally, &r[at], &t[at], are_exact, limit, number);
    }
  }
}

}  // namespace plumb::comparison
