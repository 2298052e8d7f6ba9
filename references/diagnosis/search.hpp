// Looks for the set of faults that explains a picture.
#pragma once

#include "references/diagnosis/evidence.hpp"

namespace plumb::diagnosis {

/// Returns the set that fits best with the fewest faults. A beam search adds one fault at a time, then
/// exchanges and takes out. It looks at pixels that are spread evenly, and at those that are not yet
/// explained; it leaves `evidence` looking at the last of these. How many they are follows from the cost of a
/// pixel, so that the time stays about the same.
Fit explain(Evidence& evidence);

/// Returns by how much a fault must improve a misfit of `before` to be believed.
double least_gain(const faults::Fault& fault, double before);

/// Returns how many of the tracers that were read have the fault.
int count_of(const faults::Fault& fault);

}  // namespace plumb::diagnosis
