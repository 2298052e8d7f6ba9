// A picture as a file holds it.
#pragma once

#include <vector>

namespace plumb {

/// What a file keeps a component in.
enum class Sample { bits8, bits16, half, float32 };

/// Some formats have other channel counts than three.
struct ImageFile {
  int width = 0;
  int height = 0;
  int channels = 0;
  Sample sample = Sample::float32;
  std::vector<float> values;  ///< interleaved, row 0 on top; integers scaled to 0..1
};

}  // namespace plumb
