// The gate of `plumb verify`, on a picture that somebody made.
#pragma once

#include "tests/bench/gate_power/experiment.hpp"

namespace plumb::gate_power {

/// Whether the picture passes: every pixel over 1e-6 has a proven cause, and the causes keep their bounds.
bool passes_our_gate(const Subject& subject, const Image& given, Made made);

}  // namespace plumb::gate_power
