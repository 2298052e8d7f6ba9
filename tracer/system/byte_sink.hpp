// Where the bytes of a file go; an interface, so that modules can write, too.
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

  /// From the position on, which then is behind them. Throws std::runtime_error naming the file and the
  /// cause.
  virtual void write(std::string_view bytes) = 0;
  /// The next position, in bytes from the file's start; what is left out on the way is filled later.
  virtual void seek(std::uint64_t position) = 0;
};

}  // namespace plumb
