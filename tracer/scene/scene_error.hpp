// What is wrong with a scene as a whole.
#pragma once

#include <stdexcept>

namespace plumb {

/// A file that cannot be used, with a message that names it.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumb
