// One pixel of a picture beside the right one, as the picture's file holds it.
#pragma once

#include <array>

#include "references/diagnosis/output_encoding.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::diagnosis {

struct PixelBeside {
  /// Red, green and blue as the file has them and as a right tracer would write them: whole levels, 0 to 255
  /// in 8 bits; in a file of floats the colours themselves.
  std::array<double, 3> seen, expected;
  OutputEncoding encoding;  ///< the one in which the whole picture is nearest to the right one
};

/// The picture is of the shot's size, and the pixel lies in it. Throws std::runtime_error when the scene
/// cannot be traced.
PixelBeside pixel_beside(const Shot& shot, const ImageFile& seen, int x, int y);

}  // namespace plumb::diagnosis
