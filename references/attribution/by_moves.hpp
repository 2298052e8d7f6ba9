// Causes that lie in where surfaces are: what moving them by less than the reference resolves changes.
#pragma once

#include <set>

#include "references/attribution/inquiry.hpp"

namespace plumb::attribution {

/// Edges, coincident surfaces and the reference's tolerance. Returns the shapes of the inquiry's scene that
/// take part.
std::set<ShapeId> explain_by_moves(const Inquiry& inquiry, const SuspectPixels& pixels);

}  // namespace plumb::attribution
