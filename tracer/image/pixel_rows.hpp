// A picture whose rows are looked at one after the other, where the file lies in memory or where it was
// decoded. Large float files are neither copied nor held twice.
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
  Sample sample = Sample::float32;  ///< the type in the file; the next two tell that in memory
  bool is_bytes = false;            ///< 8 bits a component, otherwise float32
  bool is_double = false;           ///< float64, for values that float32 cannot hold
  bool is_big_endian = false;       ///< byte order of the floats
  std::vector<std::size_t> planes;  ///< byte offset of each channel in a row; empty when interleaved
  const std::byte* top = nullptr;   ///< first byte of row 0; not aligned
  std::ptrdiff_t stride = 0;        ///< bytes to the next row; negative when the file has the last row first
  std::shared_ptr<const void> owner;  ///< keeps the bytes alive
  FileContents contents;

  std::size_t row_values() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
  const std::byte* row(int y) const { return top + y * stride; }
  /// Returns row y as interleaved native float32, not aligned: where it lies, or made in `scratch`.
  const std::byte* floats(int y, std::vector<float>& scratch) const;
  /// Copies row y as interleaved float32 to `out`; bytes become 0..1, doubles are rounded.
  void copy_row(int y, float* out) const;
  /// The same without rounding doubles.
  void copy_row(int y, double* out) const;
};

/// Returns rows of these channels alone, in this order, given by their indices.
PixelRows with_channels(const PixelRows& rows, const std::vector<std::size_t>& places);

/// Takes the values over; they are not copied.
PixelRows rows_of(ImageFile&& file);
/// Copies all rows into an interleaved picture, row 0 on top. Throws std::runtime_error above 2^28 values.
ImageFile image_of(const PixelRows& rows);

}  // namespace plumb
