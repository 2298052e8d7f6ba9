// Between a decoder, which runs in a confined process, and the program that asked for the picture.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/image/image_file.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb {

/// A component of a pixel in memory.
enum class Component { byte, float32, float64 };

inline std::size_t size_of(Component component) {
  if (component == Component::byte) return 1;
  return component == Component::float32 ? sizeof(float) : sizeof(double);
}

/// How rows lie in memory: interleaved, native, row 0 on top, one after the other.
struct Shape {
  int width = 0;
  int height = 0;
  int channels = 0;
  Component component = Component::float32;
  Sample sample = Sample::float32;
  FileContents contents;
};

/// Reads what a decoder itself does not: float32 of all channels, interleaved in the order of `names`, of the
/// data window of a part of an EXR. Returns an empty string, or what went wrong.
using ReadOpenExr = std::string (*)(std::string_view bytes, int part, const Window& data,
                                    const std::vector<std::string>& names, float* values);

/// That one is needed, and not at hand.
struct OtherDecoderNeeded {};

class Canvas {
 public:
  virtual ~Canvas() = default;
  /// Zeroed memory for all rows; called once. Throws when the picture is too large.
  virtual std::byte* rows_for(const Shape& shape) = 0;
};

}  // namespace plumb
