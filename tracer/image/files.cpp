#include "tracer/image/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <stdexcept>

#include "tracer/image/cleanup.hpp"

namespace plumb {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw std::runtime_error(path + ": cannot be written: " + std::strerror(error));
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(path, written < 0 ? errno : ENOSPC);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

bool is_special(const std::string& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/// A descriptor that is closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

void write_to(const std::string& target, int flags, std::string_view bytes, const std::string& named) {
  constexpr mode_t readable_by_all = 0666;
  const Descriptor file(::open(target.c_str(), flags | O_CLOEXEC, readable_by_all));
  if (file.number() < 0) fail(named, errno);
  write_all(file.number(), bytes, named);
}

/// A short name in the same directory.
std::string path_aside(const std::string& path) {
  std::random_device random;
  const std::size_t slash = path.find_last_of('/');
  const std::string directory = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  return directory + ".plumb-" + std::to_string(random()) + std::to_string(random());
}

/// Renames the file written aside, after its data are on disk; removes it when that fails.
void put_in_place(const std::string& aside, const std::string& path) {
  int error = 0;
  {
    const Descriptor file(::open(aside.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.number() < 0 || ::fsync(file.number()) != 0) error = errno;
  }
  if (error == 0 && std::rename(aside.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(aside.c_str());
  fail(path, error);
}

}  // namespace

std::string read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat info {};
  if (file.number() < 0 || ::fstat(file.number(), &info) != 0) {
    throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  }
  if (S_ISDIR(info.st_mode)) throw std::runtime_error(path + ": is a directory, expected a file");
  constexpr std::size_t least_room = std::size_t{1} << 16;
  std::string bytes(static_cast<std::size_t>(info.st_size) + least_room, '\0');
  std::size_t size = 0;
  for (;;) {
    const ssize_t got = ::read(file.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  bytes.resize(size);
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  if (path == "-") return write_all(STDOUT_FILENO, bytes, "standard output");
  if (is_special(path)) return write_to(path, O_WRONLY, bytes, path);
  const std::string aside = path_aside(path);
  const RemovedOnSignal removed(aside);
  try {
    write_to(aside, O_WRONLY | O_CREAT | O_EXCL, bytes, path);
  } catch (...) {
    ::unlink(aside.c_str());
    throw;
  }
  put_in_place(aside, path);
}

}  // namespace plumb
