// Shared objects of ours beside the program, loaded when they are first needed and kept.
#pragma once

#include <string>

namespace plumb {

/// Throws std::runtime_error naming what is missing.
void* module_symbol(const std::string& module, const std::string& name);

}  // namespace plumb
