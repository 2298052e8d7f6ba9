#include "references/comparison/hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "references/comparison/curves.hpp"

namespace plumb::comparison {
namespace {

double clamped(double v) { return std::clamp(v, 0.0, 1.0); }

void add_geometry(std::vector<Hypothesis>& list) {
  list.push_back({.name = "rows_flipped", .text = "rows are flipped", .flips_rows = true});
  list.push_back({.name = "columns_mirrored", .text = "columns are mirrored", .mirrors_columns = true});
  list.push_back(
      {.name = "rotated", .text = "turned by 180 degrees", .flips_rows = true, .mirrors_columns = true});
  list.push_back(
      {.name = "channels_swapped", .text = "red and blue are swapped (BGR)", .swaps_channels = true});
  for (const auto& [dx, dy] :
       {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
    std::string text = "shifted by one pixel:";
    if (dx != 0) text += dx > 0 ? " to the right" : " to the left";
    if (dy != 0) text += std::string(dx != 0 ? " and" : "") + (dy > 0 ? " down" : " up");
    list.push_back({.name = "shifted", .text = text, .dx = dx, .dy = dy});
  }
}

void add_curves(std::vector<Hypothesis>& list) {
  list.push_back({.name = "srgb_encoded",
                  .text = "the test picture is gamma-encoded (sRGB), the reference linear",
                  .curve = curves::srgb_encoded});
  list.push_back({.name = "srgb_decoded",
                  .text = "the reference is gamma-encoded (sRGB), the test picture linear",
                  .curve = curves::srgb_decoded});
  list.push_back({.name = "tone_mapped",
                  .text = "the test picture is tone-mapped, c / (c + 1), the reference is not",
                  .curve = curves::tone_mapped});
  list.push_back({.name = "tone_map_missing",
                  .text = "the reference is tone-mapped, c / (c + 1), the test picture is not",
                  .curve = [](double v) { return v < 1 ? v / (1 - v) : INFINITY; }});
}

/// Colours from 0 to 1 in a file of whole numbers.
struct Integers {
  int bits;
  int most;
};
constexpr Integers integers_tried[] = {{8, 255}, {16, 65535}};

void add_integers(std::vector<Hypothesis>& list, const Integers& file, const std::string& name,
                  const std::string& text, const std::function<double(double)>& curve) {
  const std::string bits = std::to_string(file.bits);
  const double step = 1.0 / file.most;
  // Float arithmetic before the rounding moves a value by some 1e-7: far less than a thousandth of a step of
  // 8 bits, or than a tenth of one of 16.
  const double noise = std::min(1e-3 / 255, 0.1 * step);
  const auto is_level = [most = file.most](float value) { return curves::is_level(value, most); };
  list.push_back({.name = name + "rounded_to_" + bits + "_bits",
                  .text = text + "rounded to " + bits + " bits",
                  .curve = curve,
                  .least = -0.5 * step - noise,
                  .most = 0.5 * step + noise,
                  .is_level = is_level,
                  .bits = file.bits,
                  .because = "half a step of " + bits + " bits is 1/" + std::to_string(2 * file.most)});
  list.push_back({.name = name + "truncated_to_" + bits + "_bits",
                  .text = text + "truncated to " + bits + " bits",
                  .curve = curve,
                  .least = -step - noise,
                  .most = noise,
                  .is_level = is_level,
                  .bits = file.bits,
                  .because = "a step of " + bits + " bits is 1/" + std::to_string(file.most) +
                             ", and truncation only darkens"});
}

}  // namespace

const std::vector<Hypothesis>& hypotheses() {
  static const std::vector<Hypothesis> list = [] {
    std::vector<Hypothesis> made;
    add_geometry(made);
    add_curves(made);
    made.push_back({.name = "half",
                    .text = "the test picture holds half floats, the reference more",
                    .curve = [](double v) { return curves::half_rounded(static_cast<float>(v)); },
                    .is_level = [](float v) { return curves::half_rounded(v) == v; }});
    for (const Integers& file : integers_tried) {
      add_integers(made, file, "", "the test picture is ", clamped);
      add_integers(made, file, "srgb_encoded_", "the test picture is gamma-encoded (sRGB) and ",
                   [](double v) { return curves::srgb_encoded(clamped(v)); });
      add_integers(made, file, "tone_mapped_", "the test picture is tone-mapped, c / (c + 1), and ",
                   curves::tone_mapped);
    }
    return made;
  }();
  return list;
}

}  // namespace plumb::comparison
