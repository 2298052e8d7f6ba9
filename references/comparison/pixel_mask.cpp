#include "references/comparison/pixel_mask.hpp"

#include <algorithm>

namespace plumb::comparison {

PixelMask::PixelMask(int width, int height, bool counts)
    : width_(width),
      height_(height),
      counts_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), counts ? 1 : 0) {}

void PixelMask::set(const Window& rectangle, bool counts) {
  const auto clipped = [](long long at, int size) {
    return static_cast<int>(std::clamp(at, 0LL, 0LL + size));
  };
  const int left = clipped(rectangle.x, width_);
  const int right = clipped(0LL + rectangle.x + rectangle.width, width_);
  const int bottom = clipped(0LL + rectangle.y + rectangle.height, height_);
  for (int y = clipped(rectangle.y, height_); y < bottom; ++y)
    for (int x = left; x < right; ++x) set(x, y, counts);
}

std::size_t PixelMask::count() const {
  return static_cast<std::size_t>(std::count(counts_.begin(), counts_.end(), 1));
}

}  // namespace plumb::comparison
