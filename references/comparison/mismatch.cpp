#include "references/comparison/mismatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "references/comparison/comparison_exact.hpp"
#include "references/comparison/hypothesis.hpp"

namespace plumb::comparison {
namespace {

/// The sum of squared differences, and the number of pixels that differ.
struct Rest {
  double squares = 0;
  std::size_t pixels_over = 0;
};

/// Adds in eight sums, which a processor computes side by side.
double sum_of_squares(const std::vector<float>& values, const std::vector<double>& expected,
                      std::size_t size) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> sums{};
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) {
      const double difference = values[i + k] - expected[i + k];
      sums[k] += difference * difference;
    }
  }
  for (; i < size; ++i) sums[0] += (values[i] - expected[i]) * (values[i] - expected[i]);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Tries hypotheses on the two pictures, a pair of rows at a time.
class Trial {
 public:
  Trial(const PixelRows& reference, const PixelRows& test, Limit limit)
      : reference_(reference),
        test_(test),
        limit_(limit),
        channels_(static_cast<std::size_t>(reference.channels)),
        r_(reference.row_values()),
        t_(r_.size()),
        r_some_(most_at_once * channels_),
        t_some_(r_some_.size()),
        expected_(r_some_.size()) {}

  /// True if rest() would certainly find more than `most_squares`. It finds out without counting pixels,
  /// which is fast: most hypotheses are wrong. The pictures must have finite pixels only.
  bool is_refuted(const Hypothesis& h, double most_squares) {
    if (h.is_level || !h.because.empty()) return false;  // rest() is quick
    constexpr double rounding = 1e-6;                    // of both orders of adding, below 2^53 / 10^9 values
    double squares = 0;
    for (int i = 0; i < reference_.height; ++i) {
      const int y = scattered(i), other = row_of_test(h, y);
      if (other < 0 || other >= reference_.height) continue;
      const std::byte* const r = reference_.floats(y, r_);
      const std::byte* const t = test_.floats(other, t_);
      const int end = std::min(reference_.width, reference_.width - h.dx);
      for (int x = std::max(0, -h.dx); x < end; x += most_at_once) {
        squares += squares_of_some(h, r, t, x, std::min(most_at_once, end - x));
        if (squares > most_squares * (1 + rounding)) return true;
      }
    }
    return false;
  }

  /// Returns nothing as soon as more than `most_squares` are left or a value contradicts the hypothesis.
  std::optional<Rest> rest(const Hypothesis& h, double most_squares) {
    Rest rest;
    for (int i = 0; i < reference_.height; ++i) {
      const int y = scattered(i), other = row_of_test(h, y);
      if (other < 0 || other >= reference_.height) continue;
      reference_.copy_row(y, r_.data());
      test_.copy_row(other, t_.data());
      if (!add_row(h, most_squares, rest)) return std::nullopt;
    }
    return rest;
  }

  /// Returns the squared differences of the pixels for which the hypothesis leaves no counterpart in the
  /// other picture: it lies outside or is not finite.
  double squares_lost(const Hypothesis& h) {
    double sum = 0;
    std::vector<float> counterparts(t_.size());
    for (int y = 0; y < reference_.height; ++y) {
      reference_.copy_row(y, r_.data());
      test_.copy_row(y, t_.data());
      const int other = row_of_test(h, y);
      const bool has_row = other >= 0 && other < reference_.height;
      if (has_row) test_.copy_row(other, counterparts.data());
      for (int x = 0; x < reference_.width; ++x) {
        if (!is_finite(at(r_, x)) || !is_finite(at(t_, x))) continue;
        const int column = column_of_test(h, x);
        const bool has_pixel = has_row && column >= 0 && column < reference_.width;
        const bool is_kept = has_pixel && is_finite(at(counterparts, column)) && is_moved_to(h, x, y);
        if (!is_kept) sum += squares_at(x);
      }
    }
    return sum;
  }

 private:
  static constexpr int most_at_once = 64;  ///< pixels

  int row_of_test(const Hypothesis& h, int y) const {
    return (h.flips_rows ? reference_.height - 1 - y : y) + h.dy;
  }

  int column_of_test(const Hypothesis& h, int x) const {
    return (h.mirrors_columns ? reference_.width - 1 - x : x) + h.dx;
  }

  /// True if this pixel of the test picture is the counterpart of one inside the reference. A flip leaves
  /// none out, so that only the shift counts.
  bool is_moved_to(const Hypothesis& h, int x, int y) const {
    const int column = x - h.dx, row = y - h.dy;
    return column >= 0 && column < reference_.width && row >= 0 && row < reference_.height;
  }

  bool is_finite(const float* pixel) const {
    return std::all_of(pixel, pixel + channels_, [](float v) { return std::isfinite(v); });
  }

  /// Returns the squared differences of `count` pixels of the reference's row, from x on.
  double squares_of_some(const Hypothesis& h, const std::byte* r, const std::byte* t, int x, int count) {
    const std::size_t pixel = channels_ * sizeof(float), size = static_cast<std::size_t>(count) * channels_;
    const int other = h.mirrors_columns ? reference_.width - x - count : x + h.dx;
    std::memcpy(r_some_.data(), r + static_cast<std::size_t>(x) * pixel, size * sizeof(float));
    std::memcpy(t_some_.data(), t + static_cast<std::size_t>(other) * pixel, size * sizeof(float));
    if (h.mirrors_columns) {
      std::reverse(t_some_.begin(), t_some_.begin() + static_cast<std::ptrdiff_t>(size));
      for (std::size_t i = 0; i < size; i += channels_) std::reverse(&t_some_[i], &t_some_[i] + channels_);
    }
    if (h.swaps_channels && channels_ >= 3) {
      for (std::size_t i = 0; i < size; i += channels_) std::swap(r_some_[i], r_some_[i + 2]);
    }
    if (h.curve) {
      std::transform(r_some_.begin(), r_some_.begin() + static_cast<std::ptrdiff_t>(size), expected_.begin(),
                     h.curve);
    } else {
      std::copy_n(r_some_.begin(), size, expected_.begin());
    }
    return sum_of_squares(t_some_, expected_, size);
  }

  /// Returns a row for each i, all of them in an order in which neighbours are far apart. What only a part of
  /// the picture shows, shows soon.
  int scattered(int i) const {
    constexpr int rows_apart = 61;
    const int rounds = (reference_.height + rows_apart - 1) / rows_apart;
    const int full = reference_.height % rows_apart == 0 ? rows_apart : reference_.height % rows_apart;
    const int in_full = full * rounds;
    if (i < in_full) return i % rounds * rows_apart + i / rounds;
    return (i - in_full) % (rounds - 1) * rows_apart + full + (i - in_full) / (rounds - 1);
  }

  bool add_row(const Hypothesis& h, double most_squares, Rest& rest) {
    for (int x = 0; x < reference_.width; ++x) {
      const int other = column_of_test(h, x);
      if (other < 0 || other >= reference_.width) continue;
      if (!add_pixel(h, x, other, rest) || rest.squares > most_squares) return false;
    }
    return true;
  }

  const float* at(const std::vector<float>& row, int x) const {
    return row.data() + static_cast<std::size_t>(x) * static_cast<std::size_t>(reference_.channels);
  }

  bool add_pixel(const Hypothesis& h, int x, int other, Rest& rest) {
    const float* const r = at(r_, x);
    const float* const t = at(t_, other);
    const int channels = reference_.channels;
    if (!is_finite(r) || !is_finite(t)) return true;
    if (h.is_level && !std::all_of(t, t + channels, h.is_level)) return false;
    if (!h.because.empty()) return is_within_bounds(h, r, t);
    bool is_over = false;
    double squares = 0;
    for (int c = 0; c < channels; ++c) {
      const double e = expected(h, r, c), difference = t[c] - e;
      squares += difference * difference;
      is_over |= !std::isfinite(e) || !(std::abs(difference) <= limit_.at(e));
    }
    rest.squares += squares;
    rest.pixels_over += is_over ? 1 : 0;
    return true;
  }

  double expected(const Hypothesis& h, const float* r, int channel) const {
    const int from = h.swaps_channels && channel < 3 && reference_.channels >= 3 ? 2 - channel : channel;
    return h.curve ? h.curve(r[from]) : static_cast<double>(r[from]);
  }

  bool is_within_bounds(const Hypothesis& h, const float* r, const float* t) const {
    for (int c = 0; c < reference_.channels; ++c) {
      const double difference = t[c] - expected(h, r, c);
      if (!(difference >= h.least && difference <= h.most)) return false;
    }
    return true;
  }

  double squares_at(int x) const {
    double sum = 0;
    for (int c = 0; c < reference_.channels; ++c) {
      const double difference = at(t_, x)[c] - static_cast<double>(at(r_, x)[c]);
      sum += difference * difference;
    }
    return sum;
  }

  const PixelRows& reference_;
  const PixelRows& test_;
  Limit limit_;
  std::size_t channels_;
  std::vector<float> r_;
  std::vector<float> t_;
  std::vector<float> r_some_;
  std::vector<float> t_some_;
  std::vector<double> expected_;
};

/// True if the file already holds integers of this depth, so that quantising explains nothing.
bool is_of_integers(const PixelRows& rows, int bits) {
  return rows.is_bytes || rows.sample == Sample::bits8 || (bits == 16 && rows.sample == Sample::bits16);
}

/// Returns the picture with NaN where the mask leaves pixels out, because a pixel that is not finite explains
/// nothing.
PixelRows without_masked(const PixelRows& rows, const PixelMask& mask) {
  ImageFile file = image_of(rows);
  const auto channels = static_cast<std::size_t>(file.channels);
  float* pixel = file.values.data();
  for (int y = 0; y < file.height; ++y) {
    for (int x = 0; x < file.width; ++x, pixel += channels)
      if (!mask.has(x, y)) std::fill_n(pixel, channels, std::numeric_limits<float>::quiet_NaN());
  }
  return rows_of(std::move(file));
}

bool moves_pixels(const Hypothesis& h) { return h.dx != 0 || h.dy != 0; }
bool turns_pixels(const Hypothesis& h) { return h.flips_rows || h.mirrors_columns; }

std::optional<LikelyCause> masked_cause(const PixelRows& reference, const PixelRows& test, Limit limit,
                                        Comparison comparison, const PixelMask& mask) {
  const auto all = static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height);
  comparison.non_finite += all - comparison.pixels;
  comparison.pixels = all;
  return likely_cause(without_masked(reference, mask), without_masked(test, mask), limit, comparison);
}

}  // namespace

std::optional<LikelyCause> likely_cause(const PixelRows& reference, const PixelRows& test, Limit limit,
                                        const Comparison& comparison, const PixelMask& mask) {
  if (needs_doubles(reference, test)) return std::nullopt;  // these values are no colours
  if (!mask.has_all()) return masked_cause(reference, test, limit, comparison, mask);
  const auto finite = static_cast<double>((comparison.pixels - comparison.non_finite) *
                                          static_cast<std::size_t>(reference.channels));
  const double before = comparison.rms_error * comparison.rms_error * finite;
  if (!(before > 0)) return std::nullopt;  // what differs is not finite
  constexpr double share_left = 0.01;
  std::optional<LikelyCause> best;
  Trial trial(reference, test, limit);
  for (const Hypothesis& h : hypotheses()) {
    if (h.is_level && is_of_integers(reference, h.bits)) continue;
    if (comparison.non_finite == 0 && trial.is_refuted(h, share_left * before)) continue;
    const auto rest = trial.rest(h, share_left * before);
    if (!rest) continue;
    // A move that merely loses the pixels that differ explains nothing.
    const bool may_lose = moves_pixels(h) || (turns_pixels(h) && comparison.non_finite > 0);
    if (may_lose && trial.squares_lost(h) > 0.5 * before) continue;
    LikelyCause cause{h.name, h.text, rest->pixels_over, 1 - rest->squares / before, h.because};
    if (cause.pixels_over == 0) return cause;
    if (!best || cause.removed > best->removed) best = cause;
  }
  return best;
}

}  // namespace plumb::comparison
