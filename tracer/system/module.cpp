#include "tracer/system/module.hpp"

#include <dlfcn.h>

#include <stdexcept>

#include "tracer/system/installation.hpp"

namespace plumb {

void* module_symbol(const std::string& module, const std::string& name) {
  const std::string path = module_path(module);
  void* const loaded = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // a second time is for free
  if (loaded == nullptr) throw std::runtime_error(std::string("a module cannot be loaded: ") + dlerror());
  void* const found = dlsym(loaded, name.c_str());
  if (found == nullptr) throw std::runtime_error(path + " has no " + name);
  return found;
}

}  // namespace plumb
