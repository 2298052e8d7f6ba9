#include "tests/bench/gate_power/our_gate.hpp"

#include <algorithm>
#include <cmath>

#include "references/attribution.hpp"
#include "references/comparison.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::gate_power {
namespace {

using references::Budget;
using references::Cause;
using references::PixelPlace;

constexpr double tolerance =
    1e-6;  // what POV-Ray's float32 pixels allow; see README, "How agreement is judged"

/// How much a right picture changes from this pixel to its neighbours: what differs where this is small is
/// hardly an edge.
double contrast(const Image& image, PixelPlace p) {
  double most = 0;
  for (int y = std::max(0, p.y - 1); y <= std::min(image.height - 1, p.y + 1); ++y) {
    for (int x = std::max(0, p.x - 1); x <= std::min(image.width - 1, p.x + 1); ++x) {
      for (int c = 0; c < 3; ++c) {
        const double step = std::abs(double{image.pixel(x, y)[c]} - double{image.pixel(p.x, p.y)[c]});
        most = std::max(most, step);
      }
    }
  }
  return most;
}

/// The right picture, with the given one's values at some pixels.
Image with_pixels_of(const Image& right, const Image& given, const std::vector<PixelPlace>& pixels) {
  Image mixed = right;
  for (const PixelPlace p : pixels) std::copy_n(given.pixel(p.x, p.y), 3, mixed.pixel(p.x, p.y));
  return mixed;
}

Budget budget_of(const Subject& s, const Image& given, references::Precision precision) {
  return references::attribute({s.scene, s.camera, s.job.options, given, s.right, tolerance, precision});
}

/// Proving a pixel takes thousands of rays, and one unexplained pixel decides: the plainest ones are tried
/// first, a few at a time.
bool all_are_explained(const Subject& s, const Image& given, references::Precision precision) {
  std::vector<PixelPlace> over = references::pixels_over(given, s.right, tolerance);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < over.size(); ++i) order.emplace_back(contrast(s.right, over[i]), i);
  std::sort(order.begin(), order.end());
  for (std::size_t begin = 0, size = 4; begin < order.size(); begin += size, size *= 16) {
    std::vector<PixelPlace> some;
    for (std::size_t i = begin; i < std::min(begin + size, order.size()); ++i)
      some.push_back(over[order[i].second]);
    if (budget_of(s, with_pixels_of(s.right, given, some), precision).count(Cause::unexplained) > 0)
      return false;
  }
  if (over.empty()) return true;
  return references::broken_bound(budget_of(s, given, precision), given.width, given.height).empty();
}

/// Every length of the scene off by up to 2^-20 of itself: float32 rounds each to 2^-24, and the dozens of
/// operations on the way to a colour add up.
Subject as_float_may_see_it(const Subject& exact, std::mt19937& random) {
  std::uniform_real_distribution<double> rounding(-0x1p-20, 0x1p-20);
  const auto scatter = [&](Vec3d& v) {
    const double size = glm::length(v);
    v += size * Vec3d(rounding(random), rounding(random), rounding(random));
  };
  Subject s = exact;
  for (Shape& shape : s.scene.shapes) {
    if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      scatter(sphere->center);
      sphere->radius *= 1 + rounding(random);
    } else if (auto* box = std::get_if<Box>(&shape.geometry)) {
      scatter(box->min);
      scatter(box->max);
      box->max = glm::max(box->min, box->max);
    }
  }
  for (Light& light : s.scene.lights) scatter(light.position);
  scatter(s.camera.eye);
  scatter(s.camera.direction);
  return s;
}

/// The range of each pixel's colours when lengths are rounded like that, several times at random.
struct Range {
  Image least;
  Image most;
};

Range range_of_float(const Subject& s) {
  constexpr int tries = 24;
  std::mt19937 random(1);  // any seed: the ranges are to be the same every time
  Range range{s.right, s.right};
  for (int i = 0; i < tries; ++i) {
    const Subject other = as_float_may_see_it(s, random);
    const Image outcome = textbook::render(other.scene, other.camera, other.job);
    for (std::size_t k = 0; k < outcome.rgb.size(); ++k) {
      range.least.rgb[k] = std::min(range.least.rgb[k], outcome.rgb[k]);
      range.most.rgb[k] = std::max(range.most.rgb[k], outcome.rgb[k]);
    }
  }
  return range;
}

/// Within the range, widened by itself on both sides and by 2^-20 of the value.
bool is_within_float(const Range& range, const Image& given) {
  for (std::size_t k = 0; k < given.rgb.size(); ++k) {
    const double least = range.least.rgb[k];
    const double most = range.most.rgb[k];
    const double slack = most - least + 0x1p-20 * std::max(1.0, most);
    if (!(given.rgb[k] >= least - slack && given.rgb[k] <= most + slack)) return false;
  }
  return true;
}

/// Truncated values stand in the middle of what they can have been.
Image centred(const Image& truncated) {
  Image image = truncated;
  for (float& c : image.rgb) c += 0.5F / 255;
  return image;
}

}  // namespace

bool passes_our_gate(const Subject& subject, const Image& given, Made made) {
  switch (made) {
    case Made::in_float:
      return is_within_float(range_of_float(subject), given);
    case Made::bits8_rounded:
      return all_are_explained(subject, given, references::Precision::bits8);
    case Made::bits8_truncated:
      return all_are_explained(subject, centred(given), references::Precision::bits8);
    case Made::in_double:
      break;
  }
  return all_are_explained(subject, given, references::Precision::float32);
}

}  // namespace plumb::gate_power
