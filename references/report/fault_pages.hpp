// Pages for students: each fault with its formulas and its pictures.
#pragma once

#include <functional>
#include <string>

#include "references/faults/fault.hpp"

namespace plumb::report {

/// <section id=FAULT>: what is wrong, both formulas, how common it is, and the fault's own scene rendered
/// right and wrong. `remark` is HTML that follows the sentence. Throws std::runtime_error when the scene is
/// not in the directory.
std::string section_of(const faults::Fault& fault, const std::string& scenes, const std::string& remark = "");

/// All faults, by slide. `progress` is called with 0 to 1.
std::string faults_page(const std::string& scenes, const std::function<void(double)>& progress);

}  // namespace plumb::report
