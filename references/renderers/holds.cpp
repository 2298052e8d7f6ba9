#include "references/renderers/holds.hpp"

#include <stdexcept>

namespace plumb::renderers {

const char* to_string(Holds holds) {
  switch (holds) {
    case Holds::float32:
      return "float32";
    case Holds::bits16:
      return "png16";
    case Holds::bits8:
      break;
  }
  return "png8";
}

Holds holds_named(const std::string& name) {
  for (const Holds holds : {Holds::float32, Holds::bits16, Holds::bits8})
    if (name == to_string(holds)) return holds;
  throw std::invalid_argument("found '" + name + "', expected float32, png16 or png8");
}

}  // namespace plumb::renderers
