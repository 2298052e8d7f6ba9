// The comparison in double, for files whose values float32 does not hold: whole numbers of 32 bits, float64.
#pragma once

#include "references/comparison/comparison_kernels.hpp"
#include "references/comparison/limit.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "tracer/image/pixel_rows.hpp"

namespace plumb::references {

/// Whether floats would lose something.
bool needs_doubles(const PixelRows& reference, const PixelRows& test);

/// As the kernels do it; but between whole numbers of 32 bits the tolerance is not relative above 1: they are
/// exact however large they are.
void add_exactly(comparison_kernels::Tally& tally, const PixelRows& reference, const PixelRows& test,
                 Limit limit, const PixelMask& mask);

}  // namespace plumb::references
