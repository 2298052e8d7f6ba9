// How a fault is told on the terminal.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "references/faults/fault.hpp"

namespace plumb::cli {

inline std::string text_of(std::string_view view) { return std::string(view); }

/// Prints its id, and the formula that was found beside the right one.
inline void print_formulas(const faults::Fault& fault) {
  std::printf("      id     %s\n      found  %s\n      right  %s\n", text_of(fault.id).c_str(),
              text_of(fault.wrong).c_str(), text_of(fault.right).c_str());
}

}  // namespace plumb::cli
