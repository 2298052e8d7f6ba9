#include "tracer/image/decoder/shared_canvas.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace plumb::decoder {

std::byte* SharedCanvas::rows_for(const Shape& shape) {
  shape_ = shape;
  const auto pixel = static_cast<std::size_t>(shape.channels) * size_of(shape.component);
  limits_.check(path_, shape.width, shape.height, static_cast<std::int64_t>(pixel));
  const std::size_t size = values() * size_of(shape.component);
  void* mapped = MAP_FAILED;
  if (::ftruncate(file_, static_cast<off_t>(size)) == 0)
    mapped = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (mapped == MAP_FAILED) throw std::runtime_error("there is no memory for its pixels");
  pixels_ = static_cast<std::byte*>(mapped);
  return pixels_;
}

std::size_t SharedCanvas::values() const {
  return static_cast<std::size_t>(shape_.width) * static_cast<std::size_t>(shape_.height) *
         static_cast<std::size_t>(shape_.channels);
}

bool SharedCanvas::are_floats() const {
  double value = 0;
  for (std::size_t i = 0; i < values(); ++i) {
    std::memcpy(&value, pixels_ + i * sizeof value, sizeof value);
    if (static_cast<double>(static_cast<float>(value)) != value && !std::isnan(value)) return false;
  }
  return true;
}

void SharedCanvas::become_floats() {
  double value = 0;
  for (std::size_t i = 0; i < values(); ++i) {
    std::memcpy(&value, pixels_ + i * sizeof value, sizeof value);
    const auto narrow = static_cast<float>(value);
    std::memcpy(pixels_ + i * sizeof narrow, &narrow, sizeof narrow);
  }
  shape_.component = Component::float32;
  if (::ftruncate(file_, static_cast<off_t>(values() * sizeof(float))) != 0)
    throw std::runtime_error("there is no memory for its pixels");
}

const Shape& SharedCanvas::finish() {
  if (pixels_ == nullptr) throw std::runtime_error("its decoder found no picture in it");
  if (shape_.component == Component::float64 && are_floats()) become_floats();
  return shape_;
}

}  // namespace plumb::decoder
