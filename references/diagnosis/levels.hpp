// Finds the levels on which the values of a picture's file lie.
#pragma once

#include <vector>

#include "references/diagnosis/output_encoding.hpp"

namespace plumb::diagnosis {

/// The levels of a picture's colours: interleaved r g b on the scale of 0 to 255, however many there are.
struct SeenLevels {
  std::vector<float> values;  ///< not finite where the file's are not
  OutputEncoding read;        ///< what is known of levels and floats; others find the rest
};

/// Pictures of one or two channels are grey. Finds fewer levels than 256 where all values lie on them, and so
/// many values differ that chance puts them there once in a million cases.
SeenLevels seen_levels(const ImageFile& seen);

}  // namespace plumb::diagnosis
