// Finds the pixels of a picture that a right tracer, or one with certain faults, cannot have made.
#pragma once

#include <vector>

#include "references/diagnosis/evidence.hpp"

namespace plumb::diagnosis {

/// Each pixel is within what float32 and its encoding can hold, is proven to lie on an edge, or remains.
struct Remains {
  OutputEncoding encoding;
  std::vector<std::size_t> pixels;  ///< those that remain, row by row
  std::size_t edges = 0;            ///< number of those that are proven
};

/// Returns what remains of the picture that these faults give, in the encoding that leaves the fewest pixels.
///
/// A pixel is within what its encoding holds when a colour that is off by at most float32's error makes it,
/// to the last level. It is proven an edge when the scene, moved by what float32 rounds (see FloatMoves) and
/// traced again, sends its rays to another surface or hides another light, and one of the moved scenes, with
/// the same faults, gives such a colour. The engine or the textbook tracer in float32 may prove it, too. A
/// pixel whose colours are not finite always remains.
Remains remains_of(const Evidence& evidence, const FaultSet& set);

/// The same at these pixels without a proof of edges: tells of each if it is within what the encoding holds.
std::vector<bool> within(const Evidence& evidence, const FaultSet& set, const OutputEncoding& encoding,
                         const std::vector<PixelPlace>& places);

}  // namespace plumb::diagnosis
