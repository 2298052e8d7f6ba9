#include "references/hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "references/curves.hpp"

namespace plumb::references {
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

void add_8_bits(std::vector<Hypothesis>& list, const std::string& name, const std::string& text,
                const std::function<double(double)>& curve) {
  // Float arithmetic before the rounding moves a value by far less than a thousandth of a step.
  constexpr double noise = 1e-3 / 255;
  list.push_back({.name = name + "rounded_to_8_bits",
                  .text = text + "rounded to 8 bits",
                  .curve = curve,
                  .least = -0.5 / 255 - noise,
                  .most = 0.5 / 255 + noise,
                  .is_level = curves::is_8_bit,
                  .because = "half a step of 8 bits is 1/510"});
  list.push_back({.name = name + "truncated_to_8_bits",
                  .text = text + "truncated to 8 bits",
                  .curve = curve,
                  .least = -1.0 / 255 - noise,
                  .most = noise,
                  .is_level = curves::is_8_bit,
                  .because = "a step of 8 bits is 1/255, and truncation only darkens"});
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
    add_8_bits(made, "", "the test picture is ", clamped);
    add_8_bits(made, "srgb_encoded_", "the test picture is gamma-encoded (sRGB) and ",
               [](double v) { return curves::srgb_encoded(clamped(v)); });
    add_8_bits(made, "tone_mapped_", "the test picture is tone-mapped, c / (c + 1), and ",
               curves::tone_mapped);
    return made;
  }();
  return list;
}

}  // namespace plumb::references
