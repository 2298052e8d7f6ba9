#include "tests/bench/gate_power/yiq.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace plumb::gate_power {
namespace {

struct Place {
  int x;
  int y;
};

double brightness(const std::uint8_t* p) { return p[0] * 0.29889531 + p[1] * 0.58662247 + p[2] * 0.11448223; }

/// Squared distance in YIQ, weighted as in the paper; at most 35215.
double squared_distance(const std::uint8_t* p, const std::uint8_t* q) {
  const double r = p[0] - q[0];
  const double g = p[1] - q[1];
  const double b = p[2] - q[2];
  const double y = r * 0.29889531 + g * 0.58662247 + b * 0.11448223;
  const double i = r * 0.59597799 - g * 0.27417610 - b * 0.32180189;
  const double in_quadrature = r * 0.21147017 - g * 0.52261711 + b * 0.31114694;
  return 0.5053 * y * y + 0.299 * i * i + 0.1957 * in_quadrature * in_quadrature;
}

bool is_at_border(const ByteImage& image, Place p) {
  return p.x == 0 || p.y == 0 || p.x == image.width - 1 || p.y == image.height - 1;
}

std::vector<Place> neighbours(const ByteImage& image, Place p) {
  std::vector<Place> found;
  for (int y = std::max(0, p.y - 1); y <= std::min(image.height - 1, p.y + 1); ++y) {
    for (int x = std::max(0, p.x - 1); x <= std::min(image.width - 1, p.x + 1); ++x) {
      if (x != p.x || y != p.y) found.push_back({x, y});
    }
  }
  return found;
}

/// More than two neighbours of the very same colour; the border counts as one.
bool has_many_siblings(const ByteImage& image, Place p) {
  const std::uint8_t* here = image.pixel(p.x, p.y);
  int equal = is_at_border(image, p) ? 1 : 0;
  for (const Place n : neighbours(image, p))
    equal += std::equal(here, here + 3, image.pixel(n.x, n.y)) ? 1 : 0;
  return equal > 2;
}

/// The darkest and the brightest neighbour of a pixel that has both, and few as bright as itself.
struct Slope {
  Place darkest;
  Place brightest;
};

std::optional<Slope> slope_at(const ByteImage& image, Place p) {
  int equal = is_at_border(image, p) ? 1 : 0;
  double least = 0;
  double most = 0;
  Slope slope{p, p};
  for (const Place n : neighbours(image, p)) {
    const double step = brightness(image.pixel(p.x, p.y)) - brightness(image.pixel(n.x, n.y));
    if (step == 0 && ++equal > 2) return std::nullopt;
    if (step < least) {
      least = step;
      slope.darkest = n;
    } else if (step > most) {
      most = step;
      slope.brightest = n;
    }
  }
  if (least == 0 || most == 0) return std::nullopt;
  return slope;
}

bool looks_antialiased(const ByteImage& image, const ByteImage& other, Place p) {
  const auto slope = slope_at(image, p);
  if (!slope) return false;
  const auto is_flat = [&](Place n) { return has_many_siblings(image, n) && has_many_siblings(other, n); };
  return is_flat(slope->darkest) || is_flat(slope->brightest);
}

}  // namespace

int differing_pixels(const ByteImage& a, const ByteImage& b, double threshold, bool skips_antialiasing) {
  constexpr double largest = 35215;
  int differing = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double distance = squared_distance(a.pixel(x, y), b.pixel(x, y));
      if (!(distance > largest * threshold * threshold)) continue;
      const bool is_left_out =
          skips_antialiasing && (looks_antialiased(a, b, {x, y}) || looks_antialiased(b, a, {x, y}));
      differing += is_left_out ? 0 : 1;
    }
  }
  return differing;
}

}  // namespace plumb::gate_power
