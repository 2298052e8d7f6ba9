// Every sweep of the atlas: a condition, a method, and why it fails.
#pragma once

#include <string>
#include <vector>

#include "references/studies/stability/trial.hpp"

namespace plumb::references::stability {

/// A method in one real type.
struct Variant {
  std::string real;
  Probe probe;
  std::string renderer;  ///< another's name and version, or empty
};

struct Method {
  std::string id, source, cause, remedy;
  Measure measures;
  std::vector<Variant> variants;
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

/// Why a method fails under a condition, and the remedy, where these are others than its own.
void explain(const std::string& condition, Method& method);

}  // namespace plumb::references::stability
