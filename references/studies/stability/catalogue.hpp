// Every sweep of the atlas: a condition, a method, and why the method fails.
#pragma once

#include <string>
#include <vector>

#include "references/studies/stability/trial.hpp"

namespace plumb::studies::stability {

/// A method in one real type.
struct Variant {
  std::string real;
  Probe probe;
  std::string renderer;  ///< name and version of another renderer, or empty
};

struct Method {
  std::string id, source, cause, remedy;
  Measure measures;
  std::vector<Variant> variants;
};

struct ConditionEntry {
  std::string name;
  std::string unit;
  double last;    ///< of a sweep that begins at 1
  bool is_whole;  ///< true for counts, such as depths
  int rays;       ///< number per value in a full sweep
  std::vector<Method> methods;
};

std::vector<ConditionEntry> catalogue();

/// Sets why a method fails under a condition, and the remedy, where these are not its usual ones.
void explain(const std::string& condition, Method& method);

}  // namespace plumb::studies::stability
