// One update of a directory at a time, among all processes.
#pragma once

#include <string>

#include "tracer/system/descriptor.hpp"

namespace plumb::references {

/// Held until the end of its scope, or of the process.
class DirectoryLock {
 public:
  /// Waits until others have let it go. Throws std::runtime_error.
  explicit DirectoryLock(const std::string& directory);

 private:
  Descriptor descriptor_;
};

}  // namespace plumb::references
