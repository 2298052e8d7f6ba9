// A picture of linear RGB in float32.
#pragma once

#include <cstddef>
#include <vector>

namespace plumb {

/// Row 0 is the top row; three channels r g b, interleaved.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  float* pixel(int x, int y) { return rgb.data() + offset(x, y); }
  const float* pixel(int x, int y) const { return rgb.data() + offset(x, y); }
};

/// True if every pixel has the same colour, so that nothing is seen.
inline bool is_of_one_colour(const Image& image) {
  for (std::size_t i = 3; i < image.rgb.size(); ++i) {
    if (image.rgb[i] != image.rgb[i - 3]) return false;
  }
  return true;
}

}  // namespace plumb
