// How exactly a renderer's file holds its values.
#pragma once

#include <string>

namespace plumb::renderers {

enum class Holds {
  float32,
  bits16,  ///< 0..1 rounded to 1/65535
  bits8,   ///< 0..1 rounded to 1/255
};

/// Returns the name in JSON and in the cache: "float32", "png16" or "png8".
const char* to_string(Holds holds);

/// Returns the inverse. Throws std::invalid_argument for any other text.
Holds holds_named(const std::string& name);

}  // namespace plumb::renderers
