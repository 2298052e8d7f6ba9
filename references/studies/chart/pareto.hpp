// Which of several ways to the same picture nobody need pass over.
#pragma once

#include <vector>

namespace plumb::references {

struct CostAndError {
  double cost;
  double error;  ///< a NaN counts as worse than any number
};

/// For each point whether no other is better in one figure and at least as good in the other. Points equal in
/// both do not dominate each other.
std::vector<bool> pareto_front(const std::vector<CostAndError>& points);

}  // namespace plumb::references
