// Pictures whose maker says that lengths or sample positions are known only so well.
#pragma once

#include "tests/bench/gate_power/experiment.hpp"

namespace plumb::gate_power {

struct Resolution {
  double lengths;  ///< of the scene, as a fraction of each
  double samples;  ///< in pixels
};

/// float32 rounds each length to 2^-24 of it, and the dozens of operations on the way to a colour add up.
inline constexpr Resolution float_resolution{0x1p-20, 0};
/// Samples that lie within 1e-6 pixels of the centres.
inline constexpr Resolution nearby_resolution{0, 1e-6};

/// Whether every pixel is within what it takes on when lengths and samples are moved at random by up to the
/// resolution, up to 512 times; that range is widened by itself on both sides, and by what float32
/// resolves.
bool is_within_resolution(const Subject& subject, const Image& given, const Resolution& resolution);

}  // namespace plumb::gate_power
