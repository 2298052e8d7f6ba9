// A picture whose rows are looked at one after the other, where the file lies in memory or where it was
// decoded: large float files are neither copied nor held twice.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "tracer/image/image_file.hpp"

namespace plumb {

struct PixelRows {
  int width = 0;
  int height = 0;
  int channels = 0;
  Sample sample = Sample::float32;  ///< bits8 or float32 in memory; what the file held
  bool is_bytes = false;            ///< 8 bits a component in memory, otherwise float32
  bool is_double = false;           ///< float64 in memory: values that float32 does not hold
  bool is_big_endian = false;       ///< of floats
  std::vector<std::size_t> planes;  ///< byte offset of each channel in a row; empty when interleaved
  const std::byte* top = nullptr;   ///< row 0; not aligned to anything
  std::ptrdiff_t stride = 0;        ///< bytes to the next row; negative when the file has the last row first
  std::shared_ptr<const void> owner;  ///< keeps the bytes
  FileContents contents;

  std::size_t row_values() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
  const std::byte* row(int y) const { return top + y * stride; }
  /// Interleaved native float32 of row y, not aligned: where they lie, or made in `scratch`.
  const std::byte* floats(int y, std::vector<float>& scratch) const;
  /// The same, copied to `out`. Doubles are rounded.
  void copy_row(int y, float* out) const;
  /// As they are in the file.
  void copy_row(int y, double* out) const;
};

/// Of these channels alone, by their places and in this order.
PixelRows with_channels(const PixelRows& rows, const std::vector<std::size_t>& places);

/// Takes the values over.
PixelRows rows_of(ImageFile&& file);
/// Interleaved, row 0 on top.
ImageFile image_of(const PixelRows& rows);

}  // namespace plumb
