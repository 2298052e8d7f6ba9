// The error of a scene that cannot be used.
#pragma once

#include <stdexcept>

namespace plumb {

/// The message says what is wrong with the scene.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumb
