// Every sweep of the atlas: a condition, a method, and why it fails.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "references/stability/trial.hpp"

namespace plumb::references::stability {

inline constexpr std::array<const char*, 3> real_names{"float", "double", "long-double"};

struct Method {
  std::string id, source, cause, remedy;
  std::array<Experiment, 3> in_real;  ///< in the order of real_names
};

struct ConditionEntry {
  std::string name;
  std::string unit;
  double last;    ///< of a sweep from 1
  bool is_whole;  ///< counts, such as depths
  int rays;       ///< a value, in a full sweep
  std::vector<Method> methods;
};

std::vector<ConditionEntry> catalogue();

}  // namespace plumb::references::stability
