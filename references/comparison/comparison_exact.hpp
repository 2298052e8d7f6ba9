// Compares in double, for files whose values float32 cannot hold: integers of 32 bits, float64.
#pragma once

#include "references/comparison/comparison_kernels.hpp"
#include "references/comparison/limit.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::comparison {

/// True if floats would lose something.
bool needs_doubles(const PixelRows& reference, const PixelRows& test);

/// Adds to the tally as the kernels do. But between integers of 32 bits the tolerance is not relative above
/// 1, because they are exact however large they are.
void add_exactly(comparison_kernels::Tally& tally, const PixelRows& reference, const PixelRows& test,
                 Limit limit, const PixelMask& mask);

}  // namespace plumb::comparison
