#include "tests/bench/gate_power/our_gate.hpp"

#include <algorithm>
#include <cmath>

#include "references/attribution/attribution.hpp"
#include "references/comparison/comparison.hpp"
#include "references/renderers/povray.hpp"
#include "tests/bench/gate_power/resolution.hpp"

namespace plumb::gate_power {
namespace {

using attribution::Budget;
using attribution::Cause;

constexpr double tolerance =
    1e-6;  // what POV-Ray's float32 pixels allow; see RESULTS.md, "How agreement is judged"

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

Budget budget_of(const Subject& s, const Image& given, renderers::Holds holds) {
  return attribution::attribute({{s.scene, s.camera, s.job.width, s.job.height, s.job.options},
                                 given,
                                 s.right,
                                 tolerance,
                                 renderers::povray_resolution(),
                                 holds});
}

/// Whether a condition holds for all pixels over the tolerance. Proving a pixel takes thousands of rays, and
/// one unexplained pixel decides: the plainest ones are tried first, a few at a time.
template <class Condition>
bool holds_for_all_over(const Subject& s, const Image& given, const Condition& holds) {
  const std::vector<PixelPlace> over = comparison::pixels_over(given, s.right, tolerance);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < over.size(); ++i) order.emplace_back(contrast(s.right, over[i]), i);
  std::sort(order.begin(), order.end());
  for (std::size_t begin = 0, size = 4; begin < order.size(); begin += size, size *= 16) {
    std::vector<PixelPlace> some;
    for (std::size_t i = begin; i < std::min(begin + size, order.size()); ++i)
      some.push_back(over[order[i].second]);
    if (!holds(with_pixels_of(s.right, given, some))) return false;
  }
  return true;
}

OurVerdict verdict_with(const Subject& s, const Image& given, renderers::Holds holds) {
  const auto is_explained = [&](const Image& some) {
    return budget_of(s, some, holds).count(Cause::unexplained) == 0;
  };
  if (!holds_for_all_over(s, given, is_explained)) return OurVerdict::unexplained;
  const Budget whole = budget_of(s, given, holds);
  const bool is_bounded = !attribution::broken_bound(whole, given.width, given.height);
  return is_bounded ? OurVerdict::passes : OurVerdict::out_of_bounds;
}

OurVerdict verdict_within(const Subject& s, const Image& given, const Resolution& resolution) {
  const auto is_within = [&](const Image& some) { return is_within_resolution(s, some, resolution); };
  return holds_for_all_over(s, given, is_within) ? OurVerdict::passes : OurVerdict::unexplained;
}

/// Truncated values stand in the middle of what they can have been.
Image centred(const Image& truncated) {
  Image image = truncated;
  for (float& c : image.rgb) c += 0.5F / 255;
  return image;
}

}  // namespace

OurVerdict our_verdict(const Subject& subject, const Image& given, Made made) {
  switch (made) {
    case Made::in_float:
      return verdict_within(subject, given, float_resolution);
    case Made::sampled_nearby:
      return verdict_within(subject, given, nearby_resolution);
    case Made::bits8_rounded:
      return verdict_with(subject, given, renderers::Holds::bits8);
    case Made::bits8_truncated:
      return verdict_with(subject, centred(given), renderers::Holds::bits8);
    case Made::in_double:
      break;
  }
  return verdict_with(subject, given, renderers::Holds::float32);
}

}  // namespace plumb::gate_power
