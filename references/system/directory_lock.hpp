// Lets one process at a time update a directory.
#pragma once

#include <string>

#include "tracer/system/descriptor.hpp"

namespace plumb::system {

/// Holds the lock until the end of its scope, or of the process.
class DirectoryLock {
 public:
  /// Waits until others have released it. Throws std::runtime_error when the directory cannot be locked.
  explicit DirectoryLock(const std::string& directory);

 private:
  Descriptor descriptor_;
};

}  // namespace plumb::system
