// Loads our own shared objects when they are first needed, and keeps them.
#pragma once

#include <string>

namespace plumb {

/// Returns the address of a symbol. Throws std::runtime_error naming what is missing.
void* module_symbol(const std::string& module, const std::string& name);

}  // namespace plumb
