// The cause that lies in where the reference ends the recursion.
#pragma once

#include "references/attribution/inquiry.hpp"

namespace plumb::attribution {

/// Depth, of those that are unexplained.
void explain_by_depth(const Inquiry& inquiry, int depth, const SuspectPixels& pixels);

}  // namespace plumb::attribution
