// A picture as the metrics read it.
#pragma once

#include <cstddef>

namespace plumb::comparison {

/// Interleaved float32 components, row 0 on top; not owned.
struct PictureView {
  int width = 0;
  int height = 0;
  int channels = 0;
  const float* values = nullptr;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t components() const { return pixels() * static_cast<std::size_t>(channels); }
  const float* pixel(std::size_t index) const { return values + index * static_cast<std::size_t>(channels); }
};

}  // namespace plumb::comparison
