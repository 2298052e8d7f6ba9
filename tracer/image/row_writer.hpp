// A picture on its way into a file, some rows at a time.
#pragma once

#include <span>

namespace plumb {

/// Of one format; the colours come as floats or as they are in the file, of 8 bits.
template <class Component>
class RowWriter {
 public:
  RowWriter() = default;
  virtual ~RowWriter() = default;
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  /// Whole rows, interleaved r g b, below those of the call before. Throws std::runtime_error naming the
  /// file.
  virtual void write(std::span<const Component> rows) = 0;
  /// After the last row. Throws std::runtime_error naming the file.
  virtual void finish() = 0;
};

}  // namespace plumb
