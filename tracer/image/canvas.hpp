// What lies between a decoder, in a confined process, and the program that asked for the picture.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/image/image_file.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb {

/// The type of a pixel's component in memory.
enum class Component { byte, float32, float64 };

inline std::size_t size_of(Component component) {
  if (component == Component::byte) return 1;
  return component == Component::float32 ? sizeof(float) : sizeof(double);
}

/// How rows lie in memory: interleaved, in native byte order, row 0 on top, one directly after the other.
struct Shape {
  int width = 0;
  int height = 0;
  int channels = 0;
  Component component = Component::float32;
  Sample sample = Sample::float32;
  FileContents contents;
};

/// Reads what a decoder cannot read itself. Fills `values` with float32 of all channels, interleaved in the
/// order of `names`, of the data window of one part of an EXR. Returns an empty string, or what went wrong.
using ReadOpenExr = std::string (*)(std::string_view bytes, int part, const Window& data,
                                    const std::vector<std::string>& names, float* values);

/// Thrown when a ReadOpenExr is needed and none is at hand.
struct OtherDecoderNeeded {};

/// Where a decoder puts its pixels.
class Canvas {
 public:
  virtual ~Canvas() = default;
  /// Returns zeroed memory for all rows. It may be called once. Throws when the picture is too large.
  virtual std::byte* rows_for(const Shape& shape) = 0;
};

}  // namespace plumb
