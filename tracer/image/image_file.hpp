// A picture as a file holds it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// What a file keeps a component in.
enum class Sample { bits8, bits16, half, float32 };

/// A rectangle of pixels, x to the right and y down.
struct Window {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Which of a file's contents were read, and what else it holds.
struct FileContents {
  std::vector<std::string>
      channels;                  ///< names in the order in memory, e.g. R G B A; empty where files name none
  std::string part;              ///< of several parts or pages, the one that was read; else empty
  std::optional<Window> window;  ///< where the rows lie in `display`, for formats that say so
  std::optional<Window> display;
  std::vector<bool> are_whole;        ///< by channel: whole numbers of 32 bits; empty where none is
  std::vector<std::string> not_read;  ///< phrases, e.g. "part 'depth' (2 of 2)"
};

/// Some formats have other channel counts than three.
struct ImageFile {
  int width = 0;
  int height = 0;
  int channels = 0;
  Sample sample = Sample::float32;
  std::vector<float> values;  ///< interleaved, row 0 on top; integers scaled to 0..1
  FileContents contents;
};

}  // namespace plumb
