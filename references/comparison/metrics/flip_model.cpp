#include "references/comparison/metrics/flip_model.hpp"

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace plumb::comparison::flip_model {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pixels_per_degree = 3840 * pi / 180;  // 0.7 m from a screen of 0.7 m
constexpr double widest_spread = 0.04;                 // of blue and yellow

/// exp(-pi^2 (k / ppd)^2 / spread): the contrast sensitivity function's Fourier transform, one dimension of
/// it.
double sensitivity(int k, double spread) {
  const double degrees = k / pixels_per_degree;
  return std::exp(-pi * pi * degrees * degrees / spread);
}

double sum_over(int radius, double spread) {
  double sum = 0;
  for (int k = -radius; k <= radius; ++k) sum += sensitivity(k, spread);
  return sum;
}

/// `factor` is that of the two-dimensional filter; each of its dimensions gets the root.
Taps gaussian(int radius, double spread, double factor) {
  Taps taps{};
  for (int k = 0; k <= radius; ++k) {
    taps[static_cast<std::size_t>(k)] = static_cast<float>(std::sqrt(factor) * sensitivity(k, spread));
  }
  return taps;
}

Taps normalised_gaussian(int radius, double spread) {
  const double sum = sum_over(radius, spread);
  return gaussian(radius, spread, 1 / (sum * sum));
}

void set_colour_filters(Model& m) {
  m.colour_radius =
      static_cast<int>(std::ceil(3 * std::sqrt(widest_spread / (2 * pi * pi)) * pixels_per_degree));
  m.achromatic = normalised_gaussian(m.colour_radius, 0.0047);
  m.red_green = normalised_gaussian(m.colour_radius, 0.0053);
  constexpr double narrow_spread = 0.025;
  const double wide = 34.1 * std::sqrt(pi / widest_spread);
  const double narrow = 13.5 * std::sqrt(pi / narrow_spread);
  const double total = wide * std::pow(sum_over(m.colour_radius, widest_spread), 2) +
                       narrow * std::pow(sum_over(m.colour_radius, narrow_spread), 2);
  m.blue_yellow_1 = gaussian(m.colour_radius, widest_spread, wide / total);
  m.blue_yellow_2 = gaussian(m.colour_radius, narrow_spread, narrow / total);
}

/// The positive weights sum to 1, the negative ones to -1, each over both halves.
void set_feature_filters(Model& m) {
  const double sigma = 0.5 * 0.082 * pixels_per_degree;
  m.feature_radius = static_cast<int>(std::ceil(3 * sigma));
  const auto g = [&](int k) { return std::exp(-k * k / (2 * sigma * sigma)); };
  const auto second = [&](int k) { return (k * k / (sigma * sigma) - 1) * g(k); };
  double smooth = 0;
  double edge = 0;
  double positive = 0;
  double negative = 0;
  for (int k = -m.feature_radius; k <= m.feature_radius; ++k) {
    smooth += g(k);
    edge += std::max(k, 0) * g(k);
    (second(k) > 0 ? positive : negative) += std::abs(second(k));
  }
  for (int k = 0; k <= m.feature_radius; ++k) {
    const auto i = static_cast<std::size_t>(k);
    m.smooth[i] = static_cast<float>(g(k) / smooth);
    m.edge[i] = static_cast<float>(k * g(k) / edge);
    m.point[i] = static_cast<float>(second(k) / (second(k) > 0 ? positive : negative));
  }
}

/// Columns: the XYZ of linear sRGB's red, green and blue under D65 (IEC 61966-2-1, exact fractions).
glm::dmat3 xyz_from_rgb() {
  return {glm::dvec3(10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382),
          glm::dvec3(8788810.0 / 24577794, 8788810.0 / 12288897, 8788810.0 / 73733382),
          glm::dvec3(4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382)};
}

std::array<float, 9> row_by_row(const glm::dmat3& m) {
  std::array<float, 9> rows{};
  for (int i = 0; i < 9; ++i) rows[static_cast<std::size_t>(i)] = static_cast<float>(m[i % 3][i / 3]);
  return rows;
}

/// CIE L*a*b* of a colour over white, with the Hunt adjustment: a and b times L / 100.
glm::dvec3 hunt_lab(const glm::dvec3& over_white) {
  constexpr double delta = 6.0 / 29;
  const auto f = [](double t) {
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const glm::dvec3 v(f(over_white.x), f(over_white.y), f(over_white.z));
  const double lightness = 116 * v.y - 16;
  return {lightness, 0.01 * lightness * 500 * (v.x - v.y), 0.01 * lightness * 200 * (v.y - v.z)};
}

void set_colours(Model& m) {
  glm::dmat3 over_white = xyz_from_rgb();
  const glm::dvec3 white = over_white * glm::dvec3(1);
  for (int column = 0; column < 3; ++column) over_white[column] /= white;
  m.white_from_rgb = row_by_row(over_white);
  m.rgb_from_white = row_by_row(glm::inverse(over_white));
  const glm::dvec3 d = hunt_lab(over_white[1]) - hunt_lab(over_white[2]);
  m.largest = static_cast<float>(std::pow(std::abs(d.x) + std::hypot(d.y, d.z), 0.7));
}

}  // namespace

const Model& model() {
  static const Model made = [] {
    Model m;
    set_colour_filters(m);
    set_feature_filters(m);
    set_colours(m);
    return m;
  }();
  return made;
}

}  // namespace plumb::comparison::flip_model
