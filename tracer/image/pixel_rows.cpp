#include "tracer/image/pixel_rows.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace plumb {
namespace {

float unit(std::byte value) {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = static_cast<float>(i) / 255;
    return t;
  }();
  return table[std::to_integer<std::size_t>(value)];
}

void interleave(const PixelRows& rows, const std::byte* row, float* out) {
  const auto channels = static_cast<std::size_t>(rows.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const std::byte* const plane = row + rows.planes[c];
    for (std::size_t x = 0; x < static_cast<std::size_t>(rows.width); ++x)
      std::memcpy(out + x * channels + c, plane + x * sizeof(float), sizeof(float));
  }
}

}  // namespace

void PixelRows::copy_row(int y, float* out) const {
  const std::byte* const from = row(y);
  if (is_bytes) {
    for (std::size_t i = 0; i < row_values(); ++i) out[i] = unit(from[i]);
    return;
  }
  if (planes.empty()) {
    std::memcpy(out, from, row_values() * sizeof(float));
  } else {
    interleave(*this, from, out);
  }
  if (!is_big_endian) return;
  for (std::size_t i = 0; i < row_values(); ++i)
    out[i] = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(out[i])));
}

const std::byte* PixelRows::floats(int y, std::vector<float>& scratch) const {
  if (!is_bytes && !is_big_endian && planes.empty()) return row(y);
  scratch.resize(row_values());
  copy_row(y, scratch.data());
  return reinterpret_cast<const std::byte*>(scratch.data());
}

PixelRows rows_of(ImageFile&& file) {
  const auto values = std::make_shared<std::vector<float>>(std::move(file.values));
  PixelRows rows;
  rows.width = file.width;
  rows.height = file.height;
  rows.channels = file.channels;
  rows.sample = file.sample;
  rows.top = reinterpret_cast<const std::byte*>(values->data());
  rows.stride = static_cast<std::ptrdiff_t>(rows.row_values() * sizeof(float));
  rows.owner = values;
  rows.contents = std::move(file.contents);
  return rows;
}

ImageFile image_of(const PixelRows& rows) {
  ImageFile file{rows.width, rows.height, rows.channels, rows.sample, {}, rows.contents};
  file.values.resize(rows.row_values() * static_cast<std::size_t>(rows.height));
  for (int y = 0; y < rows.height; ++y)
    rows.copy_row(y, file.values.data() + static_cast<std::size_t>(y) * rows.row_values());
  return file;
}

}  // namespace plumb
