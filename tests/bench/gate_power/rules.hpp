// The rules by which other projects decide whether a picture passes, as their own test suites apply them.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/gate_power/experiment.hpp"

namespace plumb::gate_power {

/// The right picture and a given one, in the forms that the rules compare: linear float32 colours, and 8-bit
/// bytes; those are of the sRGB curve, but linear on both sides when the given picture has 8 linear bits.
struct Pair {
  Image right;
  Image given;
  std::vector<std::uint8_t> right_bytes;
  std::vector<std::uint8_t> given_bytes;
};
Pair pair_of(const Image& right, const Image& given, Made made);

struct Rule {
  const char* name;
  const char* what;  ///< in one line
  bool (*passes)(const Pair&);
};
const std::vector<Rule>& rules();

}  // namespace plumb::gate_power
