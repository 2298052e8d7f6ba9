#include "references/comparison/metrics/ssim.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace plumb::comparison {
namespace {

constexpr int window = 11;

std::array<double, window> weights() {
  constexpr double sigma = 1.5;
  std::array<double, window> w{};
  double sum = 0;
  constexpr int middle = window / 2;
  for (int i = 0; i < window; ++i) {
    const double d = i - middle;
    w[static_cast<std::size_t>(i)] = std::exp(-d * d / (2 * sigma * sigma));
    sum += w[static_cast<std::size_t>(i)];
  }
  for (double& v : w) v /= sum;
  return w;
}

double grey(const float* pixel, int channels) {
  if (channels < 3) return pixel[0];
  return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
}

/// x, y, x^2, y^2 and xy of a row of pixels, or weighted sums of them, each quantity in a row of its own.
struct Moments {
  std::array<std::vector<double>, 5> rows;

  explicit Moments(std::size_t size) {
    for (auto& row : rows) row.resize(size);
  }
};

void set_pixels(Moments& to, const PictureView& r, const PictureView& t, std::size_t first) {
  auto& [x, y, xx, yy, xy] = to.rows;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = grey(r.pixel(first + i), r.channels);
    y[i] = grey(t.pixel(first + i), t.channels);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx[i] = x[i] * x[i];
    yy[i] = y[i] * y[i];
    xy[i] = x[i] * y[i];
  }
}

/// A loop that the compiler turns into vectors; each sum adds in the same order as it would alone.
void add_row(double* __restrict__ to, const double* __restrict__ from, double weight, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) to[i] += weight * from[i];
}

/// Adds to each sum what is `shift` pixels to the right.
void add(Moments& to, const Moments& from, double weight, std::size_t shift) {
  for (std::size_t m = 0; m < to.rows.size(); ++m)
    add_row(to.rows[m].data(), from.rows[m].data() + shift, weight, to.rows[m].size());
}

void clear(Moments& sums) {
  for (auto& row : sums.rows) row.assign(row.size(), 0);
}

/// Equation 13 of the paper, the sum of a row of windows.
double similarity(const Moments& sums, double peak, std::vector<double>& scratch) {
  const double c1 = (0.01 * peak) * (0.01 * peak);
  const double c2 = (0.03 * peak) * (0.03 * peak);
  const auto& [x, y, xx, yy, xy] = sums.rows;
  for (std::size_t i = 0; i < scratch.size(); ++i) {
    const double variances = xx[i] - x[i] * x[i] + yy[i] - y[i] * y[i];
    const double covariance = xy[i] - x[i] * y[i];
    scratch[i] = (2 * x[i] * y[i] + c1) * (2 * covariance + c2) /
                 ((x[i] * x[i] + y[i] * y[i] + c1) * (variances + c2));
  }
  return std::accumulate(scratch.begin(), scratch.end(), 0.0);
}

}  // namespace

std::optional<double> ssim(const PictureView& reference, const PictureView& test, double peak) {
  if (reference.width < window || reference.height < window) return std::nullopt;
  const auto w = weights();
  const auto width = static_cast<std::size_t>(reference.width);
  const auto height = static_cast<std::size_t>(reference.height);
  const std::size_t across = width - w.size() + 1, down = height - w.size() + 1;
  std::vector<Moments> last(w.size(), Moments(width));  // row y at y modulo the window
  Moments columns(width), windows(across);
  std::vector<double> scratch(across);
  double sum = 0;
  for (std::size_t y = 0; y < height; ++y) {
    set_pixels(last[y % w.size()], reference, test, y * width);
    if (y + 1 < w.size()) continue;
    clear(columns);
    for (std::size_t k = 0; k < w.size(); ++k) add(columns, last[(y + 1 + k) % w.size()], w[k], 0);
    clear(windows);
    for (std::size_t k = 0; k < w.size(); ++k) add(windows, columns, w[k], k);
    sum += similarity(windows, peak, scratch);
  }
  return sum / static_cast<double>(across * down);
}

}  // namespace plumb::comparison
