// Pixels in memory that is shared with the program which asked for them.
#pragma once

#include "tracer/image/canvas.hpp"
#include "tracer/image/read_request.hpp"

namespace plumb::decoder {

class SharedCanvas final : public Canvas {
 public:
  SharedCanvas(int file, std::string path, const ReadLimits& limits)
      : file_(file), path_(std::move(path)), limits_(limits) {}

  std::byte* rows_for(const Shape& shape) override;
  /// Ends decoding and returns the shape. Doubles become floats when float32 holds all of them.
  const Shape& finish();

 private:
  std::size_t values() const;
  bool are_floats() const;
  void become_floats();

  int file_;
  std::string path_;
  ReadLimits limits_;
  Shape shape_;
  std::byte* pixels_ = nullptr;
};

}  // namespace plumb::decoder
