#include "references/diagnosis/brightness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "references/diagnosis/diagnostician.hpp"

namespace plumb::diagnosis {
namespace {

constexpr double a_level = 1.0 / 255;

/// The levels that a picture has are offset + slope times those that it should have, or the linear colours
/// are slope times as bright.
struct Brightness {
  double slope = 1;
  double offset = 0;   ///< in levels
  double fitting = 0;  ///< share of the components that were looked at that it accounts for, to a level
};

struct Component {
  float colour;  ///< right and linear
  double seen;   ///< in levels
};

std::vector<Component> components_of(const Evidence& evidence) {
  constexpr std::size_t most = 3000;
  std::vector<PixelPlace> places = evidence.survey();
  places.resize(std::min(most, places.size()));
  const std::vector<float> colours = evidence.colours({}, places);
  std::vector<Component> components;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float* const seen = evidence.seen(evidence.index_of(places[i]));
    for (std::size_t c = 0; c < 3; ++c) components.push_back({colours[3 * i + c], double{seen[c]}});
  }
  return components;
}

/// What is neither black nor clamped, which any brightness would give.
bool tells(double seen) { return seen > 2 && seen < 253; }

void count_what_fits(Brightness& brightness, const std::vector<Component>& components,
                     const auto& expected_level) {
  constexpr double two_levels = 2;  // because both roundings may go either way
  std::size_t fits = 0;
  for (const Component& one : components) {
    const double expected = std::clamp(expected_level(one.colour), 0.0, 255.0);
    fits += std::abs(expected - one.seen) <= two_levels ? 1 : 0;
  }
  brightness.fitting = static_cast<double>(fits) / static_cast<double>(components.size());
}

/// True if there are levels enough that no line goes through all of them by chance.
bool tell_enough(const std::vector<Component>& components) {
  constexpr std::size_t least = 8;
  std::set<double> levels;
  for (const Component& one : components)
    if (tells(one.seen)) levels.insert(one.seen);
  return levels.size() >= least;
}

/// Least squares over the levels.
Brightness of_the_levels(const std::vector<Component>& components, const OutputEncoding& encoding) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [colour, seen] : components) {
    const double right = std::clamp(double{encoding.unrounded(colour)}, 0.0, 255.0);
    if (!tells(seen) || right >= 255) continue;
    n += 1;
    x += right;
    y += seen;
    xx += right * right;
    xy += right * seen;
  }
  const double spread = n * xx - x * x;
  Brightness found;
  if (n < 30 || spread < n * n) return found;  // nothing that a line can be laid through
  found.slope = (n * xy - x * y) / spread;
  found.offset = (y - found.slope * x) / n;
  count_what_fits(found, components, [&](float colour) {
    return found.offset + found.slope * std::clamp(double{encoding.unrounded(colour)}, 0.0, 255.0);
  });
  return found;
}

/// Returns the colour whose level is this.
double colour_of(double seen, const OutputEncoding& encoding) {
  double low = 0, high = 1024;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (encoding.unrounded(static_cast<float>(middle)) < seen ? low : high) = middle;
  }
  return low;
}

/// The median of what each colour is brighter by.
Brightness of_the_colours(const std::vector<Component>& components, const OutputEncoding& encoding) {
  const double half = encoding.is_float || encoding.rounds ? 0 : 0.5;
  std::vector<double> ratios;
  for (const auto& [colour, seen] : components)
    if (tells(seen) && colour > 0.02F) ratios.push_back(colour_of(seen + half, encoding) / double{colour});
  Brightness found;
  if (ratios.size() < 30) return found;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  found.slope = *middle;
  count_what_fits(found, components, [&](float colour) {
    return double{encoding.unrounded(static_cast<float>(found.slope * double{colour}))};
  });
  return found;
}

/// True if it moves levels by several times what is allowed beside it.
bool is_something(const Brightness& b) {
  constexpr double least_slope = 0.06,
                   least_offset = 8;  // because a level or two is allowed, and 0.06 is 15 of 255
  return b.slope > 0.05 && b.slope < 20 &&
         (std::abs(b.slope - 1) > least_slope || std::abs(b.offset) > least_offset);
}

/// A share of pixels may lie on edges, which a proof decides.
bool may_be(const Brightness& b) { return is_something(b) && b.fitting > 0.95; }

std::optional<Diagnosis> with_habit(const Scene& scene, const Evidence& of, const ImageFile& seen,
                                    double tolerance, Habit habit) {
  const Evidence evidence(scene, of.camera(), of.job(), seen, tolerance);
  std::optional<Diagnosis> found = Diagnostician(evidence, seen).without_search();
  if (!found || found->verdict != PictureVerdict::right) return {};
  found->verdict = PictureVerdict::right_apart;
  found->habits = {std::move(habit)};
  return found;
}

std::string times_text(double slope) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f times as bright", slope);
  return text;
}

Scene brightened(Scene scene, double times) {
  scene.ambient *= times;
  scene.background *= times;
  for (auto& light : scene.lights) light.brightness *= times;
  return scene;
}

/// In levels of 8 bits again.
ImageFile stretched_back(ImageFile file, const Brightness& by) {
  for (float& value : file.values) {
    const double right = (255 * double{value} - by.offset) / by.slope;
    value = static_cast<float>(std::round(std::clamp(right, 0.0, 255.0)) * a_level);
  }
  return file;
}

Habit habit_of_the_levels(const Brightness& b) {
  if (std::abs(b.offset) <= 2)
    return {"gain", "The finished picture is " + times_text(b.slope) + ".", Rgbd(b.slope)};
  char text[128];
  std::snprintf(text, sizeof text, "The levels run from about %.0f to %.0f, not from 0 to 255.", b.offset,
                b.offset + 255 * b.slope);
  return {"levels", text, Rgbd(b.slope)};
}

}  // namespace

std::optional<Diagnosis> right_but_for_brightness(const Evidence& evidence, const ImageFile& seen,
                                                  std::optional<double> tolerance) {
  if (evidence.encodings().front().is_float) return {};
  const std::vector<Component> components = components_of(evidence);
  if (!tell_enough(components)) return {};
  Brightness colours, levels;
  for (const OutputEncoding& encoding : evidence.encodings()) {
    const Brightness of_colours = of_the_colours(components, encoding);
    const Brightness of_levels = of_the_levels(components, encoding);
    if (is_something(of_colours) && of_colours.fitting > colours.fitting) colours = of_colours;
    if (is_something(of_levels) && of_levels.fitting > levels.fitting) levels = of_levels;
  }
  const double least = tolerance.value_or(0) + a_level;
  if (may_be(colours)) {
    Habit habit{"gain", "Everything is " + times_text(colours.slope) + ".", Rgbd(colours.slope)};
    if (auto found =
            with_habit(brightened(evidence.scene(), colours.slope), evidence, seen, least, std::move(habit)))
      return found;
  }
  if (!may_be(levels)) return {};
  return with_habit(evidence.scene(), evidence, stretched_back(seen, levels),
                    least + a_level * std::max(1.0, 1 / levels.slope), habit_of_the_levels(levels));
}

}  // namespace plumb::diagnosis
