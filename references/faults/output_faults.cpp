// What happens to a right picture after the render.
#include <algorithm>
#include <utility>

#include "references/faults/areas.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::faults {
namespace {

void tone_map(Image& image) {
  for (float& c : image.rgb) c = tone_mapped(c);
}

void blacken_first_rows(Image& image) {
  constexpr int rows = 3;
  for (int y = 0; y < std::min(rows, image.height); ++y)
    std::fill_n(image.pixel(0, y), 3 * static_cast<std::ptrdiff_t>(image.width), 0.0F);
}

void flip_rows(Image& image) {
  for (int y = 0; y < image.height / 2; ++y) {
    std::swap_ranges(image.pixel(0, y), image.pixel(0, y) + 3 * static_cast<std::ptrdiff_t>(image.width),
                     image.pixel(0, image.height - 1 - y));
  }
}

void flip_columns(Image& image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width / 2; ++x)
      std::swap_ranges(image.pixel(x, y), image.pixel(x, y) + 3, image.pixel(image.width - 1 - x, y));
  }
}

void exchange_red_and_blue(Image& image) {
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) std::swap(image.rgb[i], image.rgb[i + 2]);
}

}  // namespace

std::vector<Fault> of_the_output() {
  return {
      {"tone-map-twice", 36, "Decision", "The picture is tone-mapped once more than is asked for.",
       "c' = c / (c + 1), and again", "c' = c / (c + 1), once", "1 of 42", "ambient.sdf", nullptr, &tone_map},
      {"first-rows-black", 37, "Verfolgen von Strahlen", "The first rows are never written.",
       "rows 3 to h - 1", "rows 0 to h - 1", "not counted", "background.sdf", nullptr, &blacken_first_rows},
      {"upside-down", 37, "Verfolgen von Strahlen", "The bottom row is written first.", "row h - 1 on top",
       "row 0 on top", "not counted", "prototype-401.sdf", nullptr, &flip_rows},
      {"left-right-swapped", 37, "Verfolgen von Strahlen", "Left and right have changed places.",
       "column w - 1 at the left", "column 0 at the left", "not counted", "prototype-401.sdf", nullptr,
       &flip_columns},
      {"red-blue-exchanged", 43, "Decision", "Red and blue have changed places in the picture.",
       "blue, green, red", "red, green, blue", "not counted", "combined-still-life.sdf", nullptr,
       &exchange_red_and_blue},
  };
}

}  // namespace plumb::faults
