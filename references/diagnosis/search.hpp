// Looks for the set of faults that explains a picture.
#pragma once

#include "references/diagnosis/evidence.hpp"

namespace plumb::references {

/// The set that fits best for the least faults: a beam search that adds a fault at a time, then exchanges and
/// takes out. Looks at pixels spread evenly, and at those that are not explained yet. Leaves `evidence`
/// looking at the last of these. How many they are follows from what a pixel costs, so that the time stays
/// about the same.
Fit explain(Evidence& evidence);

/// What a fault has to improve the misfit by to be believed, next to a set that has the misfit `before`.
double least_gain(const Fault& fault, double before);

}  // namespace plumb::references
