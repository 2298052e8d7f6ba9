// Finds where two ray trees of one pixel part, and what that says.
#pragma once

#include <optional>

#include "references/attribution/attribution.hpp"
#include "references/attribution/ray_tree.hpp"

namespace plumb::attribution {

/// The cause by the first difference of the trees, from the camera on: another hit, then another light seen,
/// then other rays that follow. `extent`, in world lengths, is what the shares of the resolution are of.
/// Nothing when both trees meet the same.
std::optional<Cause> first_divergence(const RayNode& ours, const RayNode& other, double extent,
                                      const renderers::Resolution& resolution);

}  // namespace plumb::attribution
