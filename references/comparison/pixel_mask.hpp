// Tells which pixels of a picture count in a comparison.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracer/image/image_file.hpp"

namespace plumb::comparison {

class PixelMask {
 public:
  /// Every pixel counts, whatever the size of the picture.
  PixelMask() = default;
  /// In a picture of this size, every pixel counts or none does.
  PixelMask(int width, int height, bool counts);

  bool has_all() const { return counts_.empty(); }
  bool has(int x, int y) const { return has_all() || counts_[at(x, y)] != 0; }
  /// The pixel must be inside the picture, and the mask must have a size.
  void set(int x, int y, bool counts) { counts_[at(x, y)] = counts ? 1 : 0; }
  /// Sets a rectangle. Its part outside the picture is ignored.
  void set(const Window& rectangle, bool counts);
  /// Returns the number of pixels that count. The mask must have a size.
  std::size_t count() const;

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> counts_;
};

}  // namespace plumb::comparison
