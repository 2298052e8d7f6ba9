#include "references/submissions/collect.hpp"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "tracer/system/files.hpp"

namespace plumb::submissions {
namespace {

/// Opens below the directory without any symbolic link; O_NONBLOCK so that a pipe does not block.
int open_below(const std::string& directory, const std::string& name) {
  const int top = open(directory.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (top < 0) return -1;
  open_how how{};
  how.flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  const auto file = static_cast<int>(syscall(SYS_openat2, top, name.c_str(), &how, sizeof how));
  const int error = errno;
  close(top);
  errno = error;
  return file;
}

Found why_not_opened(const std::string& directory, int error) {
  switch (error) {
    case ELOOP:
    case ENXIO:
      return Found::not_a_file;
    case EACCES:
    case EPERM:
      return Found::forbidden;
    case ENOENT:
    case ENOTDIR:
    case EXDEV:  // it leads out of the directory
    case ENAMETOOLONG:
    case EINVAL:  // a name that no file can have
      return Found::nothing;
    default:
      throw std::runtime_error(directory + ": cannot be looked into: " + std::strerror(error));
  }
}

/// At most so many bytes of an open file, which may not grow any more.
std::string bytes_of(int file, std::size_t size) {
  std::string bytes(size, '\0');
  std::size_t at = 0;
  while (at < size) {
    const ssize_t got = read(file, bytes.data() + at, size - at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::runtime_error("a picture cannot be read: " + std::string(std::strerror(errno)));
    if (got == 0) break;
    at += static_cast<std::size_t>(got);
  }
  bytes.resize(at);
  return bytes;
}

}  // namespace

Found take_file(const std::string& directory, const std::string& name, std::size_t most_bytes,
                const std::string& target) {
  const int file = open_below(directory, name);
  if (file < 0) return why_not_opened(directory, errno);
  struct stat status {};
  Found found = Found::picture;
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    found = Found::not_a_file;
  } else if (static_cast<std::size_t>(status.st_size) > most_bytes) {
    found = Found::too_large;
  } else {
    write_file(target, bytes_of(file, static_cast<std::size_t>(status.st_size)));
  }
  close(file);
  return found;
}

}  // namespace plumb::submissions
