#include "references/system/directory_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace plumb::system {

DirectoryLock::DirectoryLock(const std::string& directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  int result = descriptor_.number();
  while (descriptor_.number() >= 0 && (result = ::flock(descriptor_.number(), LOCK_EX)) < 0 &&
         errno == EINTR) {
  }
  if (result < 0) throw std::runtime_error(directory + ": cannot be locked: " + std::strerror(errno));
}

}  // namespace plumb::system
