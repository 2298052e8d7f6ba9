// Tells which faults a picture shows that its tracer does not have.
#pragma once

#include <vector>

#include "references/diagnosis/diagnosis.hpp"

namespace plumb::diagnosis {

/// Returns the faults, none of those that are named or their like, with which a hundredth of the picture, or
/// more, would no longer be right, and hardly anything would become right. Returns none while the camera is
/// unknown.
std::vector<const faults::Fault*> excluded_by(const Evidence& evidence, const Diagnosis& diagnosis);

}  // namespace plumb::diagnosis
