// The inner loops of FLIP, compiled for every instruction set that the processor may have.
#pragma once

#include <cstddef>
#include <vector>

#include "references/comparison/metrics/flip.hpp"

namespace plumb::comparison::flip_kernels {

/// Rows are padded by so many floats: a kernel may run over their end by less than a vector of any processor.
inline constexpr std::size_t padding = 64;

/// A picture in YCxCz (2020, section 4.1: a linearised CIELAB), in three planes.
struct Opponent {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t stride = 0;
  std::vector<float> planes[3];
};

/// Converts a picture. `exposure` is the factor before the tone curve, for linear colours.
Opponent to_opponent(const PictureView& picture, ColourSpace space, float exposure);

/// Raises `errors` (width floats per row) to the errors of rows first..last-1 where these are larger.
void raise_errors(const Opponent& reference, const Opponent& test, std::size_t first, std::size_t last,
                  float* errors);

}  // namespace plumb::comparison::flip_kernels
