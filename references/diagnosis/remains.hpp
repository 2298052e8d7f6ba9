// Which pixels of a picture a right tracer, or one with certain faults, cannot have made.
#pragma once

#include <vector>

#include "references/diagnosis/evidence.hpp"

namespace plumb::references {

/// Every pixel is within what float32 and its encoding can hold, proven to lie on an edge, or remains.
struct Remains {
  OutputEncoding encoding;
  std::vector<std::size_t> pixels;  ///< that remain, row by row
  std::size_t edges = 0;            ///< proven
};

/// Of the picture that these faults give, written so that the fewest pixels remain.
///
/// A pixel is within what its encoding holds when a colour that is off by no more than float32 makes it, to
/// the last level. It is proven an edge when the scene, moved by what float32 rounds (see FloatMoves) and
/// traced again, sends its rays to another surface or hides another light, and one of the moved scenes, with
/// the same faults, gives such a colour; or when the engine or the textbook tracer does in float32. Colours
/// that are not finite are never either.
Remains remains_of(const Evidence& evidence, const FaultSet& set);

/// The same without a proof of edges, at these pixels: whether each is within what the encoding holds.
std::vector<bool> within(const Evidence& evidence, const FaultSet& set, const OutputEncoding& encoding,
                         const std::vector<PixelPlace>& places);

}  // namespace plumb::references
