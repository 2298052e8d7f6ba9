// A picture as a file holds it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// The type in which a file keeps a component.
enum class Sample { bits8, bits16, half, float32 };

/// A rectangle in pixels, x to the right and y down.
struct Window {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// What was read of a file, and what else the file holds.
struct FileContents {
  std::vector<std::string> channels;  ///< names in the order in memory, e.g. R G B A; empty if there are none
  std::string part;                   ///< the part or page that was read, when there are several; else empty
  std::optional<Window> window;       ///< where the rows lie in `display`, in formats that say so
  std::optional<Window> display;
  std::vector<bool> are_whole;        ///< true for each channel of 32-bit integers; empty when there is none
  std::vector<std::string> not_read;  ///< phrases, e.g. "part 'depth' (2 of 2)"
};

/// A decoded picture, of any number of channels.
struct ImageFile {
  int width = 0;
  int height = 0;
  int channels = 0;
  Sample sample = Sample::float32;
  std::vector<float> values;  ///< interleaved, row 0 on top; integers scaled to 0..1
  FileContents contents;
};

}  // namespace plumb
