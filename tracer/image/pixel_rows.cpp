#include "tracer/image/pixel_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

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
  if (is_double) {
    double value = 0;
    for (std::size_t i = 0; i < row_values(); ++i) {
      std::memcpy(&value, from + i * sizeof value, sizeof value);
      out[i] = static_cast<float>(value);
    }
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

void PixelRows::copy_row(int y, double* out) const {
  if (is_double) {
    std::memcpy(out, row(y), row_values() * sizeof(double));
    return;
  }
  std::vector<float> floats(row_values());
  copy_row(y, floats.data());
  std::copy(floats.begin(), floats.end(), out);
}

const std::byte* PixelRows::floats(int y, std::vector<float>& scratch) const {
  if (!is_bytes && !is_double && !is_big_endian && planes.empty()) return row(y);
  scratch.resize(row_values());
  copy_row(y, scratch.data());
  return reinterpret_cast<const std::byte*>(scratch.data());
}

namespace {

/// Returns the picked channels of all rows, one row after the other.
template <class Value>
PixelRows picked(const PixelRows& rows, const std::vector<std::size_t>& places) {
  const auto channels = static_cast<std::size_t>(rows.channels);
  const auto width = static_cast<std::size_t>(rows.width), height = static_cast<std::size_t>(rows.height);
  const auto values = std::make_shared<std::vector<Value>>(width * height * places.size());
  std::vector<Value> row(rows.row_values());
  auto out = values->begin();
  for (int y = 0; y < rows.height; ++y) {
    if constexpr (sizeof(Value) == 1)
      std::memcpy(row.data(), rows.row(y), row.size());
    else
      rows.copy_row(y, row.data());
    for (std::size_t x = 0; x < width; ++x) {
      for (const std::size_t place : places) *out++ = row[x * channels + place];
    }
  }
  PixelRows result = rows;
  result.is_big_endian = false;
  result.planes.clear();
  result.top = reinterpret_cast<const std::byte*>(values->data());
  result.stride = static_cast<std::ptrdiff_t>(width * places.size() * sizeof(Value));
  result.owner = values;
  return result;
}

}  // namespace

PixelRows with_channels(const PixelRows& rows, const std::vector<std::size_t>& places) {
  PixelRows result = rows;
  if (!rows.planes.empty()) {
    result.planes.clear();
    for (const std::size_t place : places) result.planes.push_back(rows.planes.at(place));
  } else {
    result = rows.is_bytes    ? picked<std::uint8_t>(rows, places)
             : rows.is_double ? picked<double>(rows, places)
                              : picked<float>(rows, places);
  }
  result.channels = static_cast<int>(places.size());
  result.contents.channels.clear();
  if (rows.contents.channels.empty()) return result;
  for (const std::size_t place : places) result.contents.channels.push_back(rows.contents.channels.at(place));
  return result;
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
  constexpr double most_values = 1 << 28;
  if (static_cast<double>(rows.row_values()) * rows.height > most_values)
    throw std::runtime_error("its size is out of range: " + std::to_string(rows.width) + " x " +
                             std::to_string(rows.height) + " pixels of " + std::to_string(rows.channels) +
                             " channels, expected at most 2^28 values");
  ImageFile file{rows.width, rows.height, rows.channels, rows.sample, {}, rows.contents};
  file.values.resize(rows.row_values() * static_cast<std::size_t>(rows.height));
  for (int y = 0; y < rows.height; ++y)
    rows.copy_row(y, file.values.data() + static_cast<std::size_t>(y) * rows.row_values());
  return file;
}

}  // namespace plumb
