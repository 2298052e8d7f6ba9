// The gate of `plumb verify`, on a picture that somebody made.
#pragma once

#include "tests/bench/gate_power/experiment.hpp"

namespace plumb::gate_power {

/// What our gate says of a picture. Bounds are looked at when every pixel is explained.
enum class OurVerdict {
  passes,        ///< every pixel over 1e-6 has a proven cause, and the causes keep their bounds
  unexplained,   ///< some pixel over has no proven cause
  out_of_bounds  ///< all have a cause, but there are more of one than such pictures have
};

OurVerdict our_verdict(const Subject& subject, const Image& given, Made made);

}  // namespace plumb::gate_power
