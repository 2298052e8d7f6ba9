// Causes that lie in how the reference's file holds its values.
#pragma once

#include "references/attribution/inquiry.hpp"

namespace plumb::attribution {

/// Clamping and rounding to integers.
void explain_by_format(const Inquiry& inquiry, const SuspectPixels& pixels);

}  // namespace plumb::attribution
