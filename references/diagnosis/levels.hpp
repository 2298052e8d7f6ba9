// Which levels the values of a picture's file lie on.
#pragma once

#include <vector>

#include "references/diagnosis/output_encoding.hpp"

namespace plumb::references {

/// The levels of a picture's colours, interleaved r g b on the scale of 0 to 255, however many there are.
struct SeenLevels {
  std::vector<float> values;  ///< not finite where the file's are not
  OutputEncoding read;        ///< levels, floats and what they lose; the rest is for others to find
};

/// Pictures of one channel, or two, are grey. Fewer levels than a file's 256 are found where the picture has
/// so many different values, all on the coarse levels, that chance puts them there once in a million cases.
SeenLevels seen_levels(const ImageFile& seen);

}  // namespace plumb::references
