// Where the bytes of a file go. It is an interface, so that modules can write, too.
#pragma once

#include <cstdint>
#include <string_view>

namespace plumb {

class ByteSink {
 public:
  ByteSink() = default;
  virtual ~ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;

  /// Writes the bytes at the position and moves it behind them. Throws std::runtime_error naming the file and
  /// the cause.
  virtual void write(std::string_view bytes) = 0;
  /// Sets the position, in bytes from the file's start. The caller writes a range that it skips later.
  virtual void seek(std::uint64_t position) = 0;
};

}  // namespace plumb
