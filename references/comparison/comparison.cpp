#include "references/comparison/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "references/comparison/comparison_exact.hpp"
#include "references/comparison/comparison_kernels.hpp"

namespace plumb::comparison {
namespace {

bool is_within(const float* reference, const float* test, int channels, Limit limit) {
  for (int c = 0; c < channels; ++c) {
    if (!std::isfinite(reference[c]) || !std::isfinite(test[c])) return false;
    const double difference = std::abs(static_cast<double>(test[c]) - static_cast<double>(reference[c]));
    if (difference > limit.at(reference[c])) return false;
  }
  return true;
}

std::vector<float> pixel_at(const PixelRows& rows, int x, int y) {
  std::vector<float> row(rows.row_values());
  rows.copy_row(y, row.data());
  const auto at = row.begin() + static_cast<std::ptrdiff_t>(x) * rows.channels;
  return {at, at + rows.channels};
}

Comparison comparison_of(const comparison_kernels::Tally& tally, std::size_t pixels,
                         const PixelRows& reference, const PixelRows& test) {
  Comparison result;
  const auto width = static_cast<std::size_t>(reference.width);
  result.pixels = pixels;
  result.non_finite = tally.non_finite;
  result.pixels_over = tally.pixels_over;
  result.max_error = tally.max_error;
  result.judged_error = tally.judged_error;
  const auto finite =
      static_cast<double>((result.pixels - tally.non_finite) * static_cast<std::size_t>(reference.channels));
  if (finite > 0) {
    result.mean_error = tally.sum / finite;
    result.rms_error = std::sqrt(tally.sum_of_squares / finite);
  }
  if (result.pixels == 0) return result;
  result.worst.x = static_cast<int>(tally.worst_pixel % width);
  result.worst.y = static_cast<int>(tally.worst_pixel / width);
  result.worst.test = pixel_at(test, result.worst.x, result.worst.y);
  result.worst.reference = pixel_at(reference, result.worst.x, result.worst.y);
  return result;
}

/// The rows do not keep the values alive.
PixelRows rows_over(int width, int height, int channels, const std::vector<float>& values) {
  PixelRows rows;
  rows.width = width;
  rows.height = height;
  rows.channels = channels;
  rows.top = reinterpret_cast<const std::byte*>(values.data());
  rows.stride = static_cast<std::ptrdiff_t>(rows.row_values() * sizeof(float));
  return rows;
}

/// A range of pixels in a row.
struct Range {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// Returns what of row y differs, for rows of bytes, extended to complete chunks. The sums then group as
/// those of a complete row.
Range differing(const PixelRows& reference, const PixelRows& test, int y) {
  constexpr std::size_t chunk = 64;
  const std::byte *const r = reference.row(y), *const t = test.row(y);
  if (std::memcmp(r, t, reference.row_values()) == 0) return {};
  const auto width = static_cast<std::size_t>(reference.width);
  const auto channels = static_cast<std::size_t>(reference.channels);
  const auto is_same = [&](std::size_t x) {
    return std::memcmp(r + x * channels, t + x * channels, std::min(chunk, width - x) * channels) == 0;
  };
  std::size_t first = 0, last = (width - 1) / chunk * chunk;
  while (is_same(first)) first += chunk;
  while (is_same(last)) last -= chunk;
  return {first, std::min(width, last + chunk)};
}

/// Returns these columns of rows of bytes. Rows of floats stay as they are, so their range must be complete.
PixelRows columns_of(PixelRows rows, Range range) {
  rows.width = static_cast<int>(range.end - range.first);
  if (rows.is_bytes) rows.top += range.first * static_cast<std::size_t>(rows.channels);
  return rows;
}

void expect_valid(Limit limit) {
  if (!(limit.tolerance >= 0) || !std::isfinite(limit.tolerance))
    throw std::invalid_argument("expected a finite tolerance >= 0");
  if (!(limit.relative >= 0) || !std::isfinite(limit.relative))
    throw std::invalid_argument("expected a finite relative tolerance >= 0");
}

/// Returns the next run of pixels in row y, from x on, that count. Both ends are the width when there is
/// none.
Range next_run(const PixelMask& mask, int y, std::size_t x, std::size_t width) {
  const auto counts = [&](std::size_t at) { return mask.has(static_cast<int>(at), y); };
  while (x < width && !counts(x)) ++x;
  Range run{x, x};
  while (run.end < width && counts(run.end)) ++run.end;
  return run;
}

Comparison compare_masked(const PixelRows& reference, const PixelRows& test, Limit limit,
                          const PixelMask& mask) {
  constexpr auto none = static_cast<std::size_t>(-1);
  comparison_kernels::Tally tally;
  tally.worst_pixel = none;  // pixel 0 may be one that does not count
  std::vector<float> reference_scratch;
  std::vector<float> test_scratch;
  const auto width = static_cast<std::size_t>(reference.width);
  const std::size_t pixel = static_cast<std::size_t>(reference.channels) * sizeof(float);
  for (int y = 0; y < reference.height; ++y) {
    Range run = next_run(mask, y, 0, width);
    if (run.first == width) continue;
    if (tally.worst_pixel == none) tally.worst_pixel = static_cast<std::size_t>(y) * width + run.first;
    const std::byte* const r = reference.floats(y, reference_scratch);
    const std::byte* const t = test.floats(y, test_scratch);
    for (; run.first < width; run = next_run(mask, y, run.end, width)) {
      comparison_kernels::add(tally, r + run.first * pixel, t + run.first * pixel, run.end - run.first,
                              reference.channels, limit, static_cast<std::size_t>(y) * width + run.first);
    }
  }
  const std::size_t pixels = mask.count();
  if (pixels == 0) throw std::invalid_argument("expected a mask that leaves at least one pixel");
  return comparison_of(tally, pixels, reference, test);
}

Comparison compare_exactly(const PixelRows& reference, const PixelRows& test, Limit limit,
                           const PixelMask& mask) {
  const std::size_t pixels =
      mask.has_all() ? static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height)
                     : mask.count();
  if (pixels == 0) throw std::invalid_argument("expected a mask that leaves at least one pixel");
  comparison_kernels::Tally tally;
  add_exactly(tally, reference, test, limit, mask);
  return comparison_of(tally, pixels, reference, test);
}

}  // namespace

Comparison compare(const PixelRows& reference, const PixelRows& test, Limit limit, const PixelMask& mask) {
  expect_valid(limit);
  if (needs_doubles(reference, test)) return compare_exactly(reference, test, limit, mask);
  if (!mask.has_all()) return compare_masked(reference, test, limit, mask);
  comparison_kernels::Tally tally;
  std::vector<float> reference_scratch;
  std::vector<float> test_scratch;
  const auto width = static_cast<std::size_t>(reference.width);
  const bool are_bytes = reference.is_bytes && test.is_bytes;
  for (int y = 0; y < reference.height; ++y) {
    // Equal bytes are finite and differ by nothing; the first row makes sure that some pixel is the worst.
    const Range range = are_bytes && y > 0 ? differing(reference, test, y) : Range{0, width};
    if (range.first == range.end) continue;
    comparison_kernels::add(tally, columns_of(reference, range).floats(y, reference_scratch),
                            columns_of(test, range).floats(y, test_scratch), range.end - range.first,
                            reference.channels, limit, static_cast<std::size_t>(y) * width + range.first);
  }
  return comparison_of(tally, width * static_cast<std::size_t>(reference.height), reference, test);
}

Comparison compare(int width, int height, int channels, const std::vector<float>& reference,
                   const std::vector<float>& test, Limit limit) {
  const auto expected =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
  if (reference.size() != expected || test.size() != expected) {
    throw std::invalid_argument("the pictures do not have " + std::to_string(width) + " x " +
                                std::to_string(height) + " pixels of " + std::to_string(channels) +
                                " channels");
  }
  return compare(rows_over(width, height, channels, reference), rows_over(width, height, channels, test),
                 limit);
}

PixelRows rows_over(const Image& image) { return rows_over(image.width, image.height, 3, image.rgb); }

void expect_one_size(const Image& reference, const Image& test) {
  if (reference.width != test.width || reference.height != test.height) {
    throw std::invalid_argument("the pictures have different sizes: reference " +
                                std::to_string(reference.width) + " x " + std::to_string(reference.height) +
                                ", test " + std::to_string(test.width) + " x " + std::to_string(test.height));
  }
}

Comparison compare(const Image& reference, const Image& test, Limit limit) {
  expect_one_size(reference, test);
  return compare(test.width, test.height, 3, reference.rgb, test.rgb, limit);
}

bool is_within(const float* reference, const float* test, Limit limit) {
  return is_within(reference, test, 3, limit);
}

std::vector<PixelPlace> pixels_over(const Image& reference, const Image& test, Limit limit,
                                    const PixelMask& mask) {
  std::vector<PixelPlace> places;
  for (int y = 0; y < test.height; ++y) {
    for (int x = 0; x < test.width; ++x) {
      if (mask.has(x, y) && !is_within(reference.pixel(x, y), test.pixel(x, y), limit))
        places.push_back({x, y});
    }
  }
  return places;
}

}  // namespace plumb::comparison
