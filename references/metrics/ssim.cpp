#include "references/metrics/ssim.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace plumb::references {
namespace {

constexpr int window = 11;

std::array<double, window> weights() {
  constexpr double sigma = 1.5;
  std::array<double, window> w{};
  double sum = 0;
  for (int i = 0; i < window; ++i) {
    const double d = i - window / 2;
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

/// Weighted sums of x, y, x^2, y^2 and xy.
struct Moments {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  void add(double weight, const Moments& m) {
    x += weight * m.x;
    y += weight * m.y;
    xx += weight * m.xx;
    yy += weight * m.yy;
    xy += weight * m.xy;
  }
};

/// Equation 13 of the paper.
double similarity(const Moments& m, double peak) {
  const double c1 = (0.01 * peak) * (0.01 * peak);
  const double c2 = (0.03 * peak) * (0.03 * peak);
  const double variances = m.xx - m.x * m.x + m.yy - m.y * m.y;
  const double covariance = m.xy - m.x * m.y;
  return (2 * m.x * m.y + c1) * (2 * covariance + c2) / ((m.x * m.x + m.y * m.y + c1) * (variances + c2));
}

/// Moments of the windows' columns whose top is row `top`.
std::vector<Moments> columns(const PictureView& r, const PictureView& t, int top,
                             const std::array<double, window>& w) {
  std::vector<Moments> sums(static_cast<std::size_t>(r.width));
  for (int k = 0; k < window; ++k) {
    const std::size_t row = static_cast<std::size_t>(top + k) * sums.size();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double x = grey(r.pixel(row + i), r.channels);
      const double y = grey(t.pixel(row + i), t.channels);
      sums[i].add(w[static_cast<std::size_t>(k)], {x, y, x * x, y * y, x * y});
    }
  }
  return sums;
}

}  // namespace

std::optional<double> ssim(const PictureView& reference, const PictureView& test, double peak) {
  if (reference.width < window || reference.height < window) return std::nullopt;
  const auto w = weights();
  const auto across = static_cast<std::size_t>(reference.width - window + 1);
  const int down = reference.height - window + 1;
  double sum = 0;
  for (int top = 0; top < down; ++top) {
    const std::vector<Moments> sums = columns(reference, test, top, w);
    for (std::size_t left = 0; left < across; ++left) {
      Moments m;
      for (std::size_t k = 0; k < w.size(); ++k) m.add(w[k], sums[left + k]);
      sum += similarity(m, peak);
    }
  }
  return sum / (static_cast<double>(across) * down);
}

}  // namespace plumb::references
