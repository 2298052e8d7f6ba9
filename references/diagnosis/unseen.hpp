// What a right picture cannot show: faults that would change nothing in it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::diagnosis {

struct UnseenFaults {
  std::vector<const faults::Fault*> faults;  ///< of fault_catalogue(), in its order
  std::size_t pixels = 0;                    ///< number that were looked at, spread over the picture
  /// File names of tests/scenes that show them, those that show most first; at most three.
  std::vector<std::string> shown_by;
};

/// Returns the faults with which each pixel that was looked at would have the same levels in a file like
/// `seen`, or in one of floats would differ by less than 1e-5, relative above 1. A fault with which the scene
/// cannot be traced is none of them. The picture is of the shot's size.
UnseenFaults unseen_faults(const Shot& shot, const ImageFile& seen);

}  // namespace plumb::diagnosis
