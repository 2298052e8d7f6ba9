// Finds out why two pictures differ as a whole. It tries the usual accidents between two programs, and names
// one only when that explains the difference.
#pragma once

#include <optional>
#include <string>

#include "references/comparison/comparison.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::comparison {

struct LikelyCause {
  std::string name;             ///< for programs: rows_flipped, shifted, srgb_encoded, half, ...
  std::string text;             ///< for people, e.g. "rows are flipped"
  std::size_t pixels_over = 0;  ///< once the cause is undone; without those that are not finite
  double removed = 1;           ///< share of the squared error that undoing it removes
  std::string because;          ///< the bound that replaced the tolerance, if one did
};

/// Undoes one accident after the other in the test picture: channel order, flips, shifts by one pixel, the
/// sRGB curve, the tone map c / (c + 1), half floats, 8 or 16 bits rounded or truncated. Returns the first
/// that leaves no pixel over, else the one that removes most, at least 99 %, of the squared error (the RMS
/// error falls to a tenth), else nothing. The pictures have one size and channel count and differ;
/// `comparison` is theirs, of the pixels of the mask.
std::optional<LikelyCause> likely_cause(const PixelRows& reference, const PixelRows& test, Limit limit,
                                        const Comparison& comparison, const PixelMask& mask = {});

}  // namespace plumb::comparison
