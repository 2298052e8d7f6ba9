// Which shapes' moves change pixels.
#pragma once

#include <set>
#include <vector>

#include "references/attribution/inquiry.hpp"

namespace plumb::attribution {

/// A pixel that moves change, and what shows it.
struct ProvenPixel {
  const AttributedPixel* pixel;
  Colour unmoved;
  int as_test;       ///< the pattern whose outcome is the test's value
  int as_reference;  ///< and the reference's
};

/// Those whose move alone changes one of the pixels.
std::set<ShapeId> shapes_that_take_part(const Inquiry& inquiry, const std::vector<ProvenPixel>& proven);

}  // namespace plumb::attribution
