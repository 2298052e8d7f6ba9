#include "tracer/image/module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace plumb {

void* module_symbol(const std::string& module, const std::string& name) {
  const auto path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / module;
  void* const loaded = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // a second time is for free
  if (loaded == nullptr) throw std::runtime_error(std::string("a module cannot be loaded: ") + dlerror());
  void* const found = dlsym(loaded, name.c_str());
  if (found == nullptr) throw std::runtime_error(path.string() + " has no " + name);
  return found;
}

}  // namespace plumb
