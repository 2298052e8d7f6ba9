// The inner loops of FLIP, for every instruction set that the processor may have.
#pragma once

#include <cstddef>
#include <vector>

#include "references/comparison/metrics/flip.hpp"

namespace plumb::references::flip_kernels {

/// Rows are padded, so that a kernel may run over their end by less than a vector of any processor.
inline constexpr std::size_t padding = 64;

/// A picture in YCxCz (2020, section 4.1: a linearised CIELAB), one plane each.
struct Opponent {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t stride = 0;
  std::vector<float> planes[3];
};

/// `exposure` is the factor before the tone curve, for linear colours.
Opponent to_opponent(const PictureView& picture, ColourSpace space, float exposure);

/// Writes the errors of rows first..last-1 into `errors` (width floats a row) where they are larger than what
/// stands there.
void raise_errors(const Opponent& reference, const Opponent& test, std::size_t first, std::size_t last,
                  float* errors);

}  // namespace plumb::references::flip_kernels
