// Writes a picture into a file, some rows at a time.
#pragma once

#include <span>

namespace plumb {

/// A writer of one format. Components are linear floats, or the 8-bit values of the file.
template <class Component>
class RowWriter {
 public:
  RowWriter() = default;
  virtual ~RowWriter() = default;
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  /// Writes complete rows, channels interleaved, below those of the call before. Throws std::runtime_error
  /// naming the file.
  virtual void write(std::span<const Component> rows) = 0;
  /// Ends the file after the last row. Throws std::runtime_error naming the file.
  virtual void finish() = 0;
};

}  // namespace plumb
