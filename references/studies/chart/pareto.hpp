// Finds those of several ways to the same picture that no other way beats.
#pragma once

#include <vector>

namespace plumb::studies {

struct CostAndError {
  double cost;
  double error;  ///< NaN counts as worse than any number
};

/// Tells for each point if no other is better in one figure and at least as good in the other. Points that
/// are equal in both do not beat each other.
std::vector<bool> pareto_front(const std::vector<CostAndError>& points);

}  // namespace plumb::studies
