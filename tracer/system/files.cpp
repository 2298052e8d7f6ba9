#include "tracer/system/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "tracer/system/descriptor.hpp"
#include "tracer/system/output_file.hpp"

namespace plumb {

std::string read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat info {};
  if (file.number() < 0 || ::fstat(file.number(), &info) != 0) {
    throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  }
  if (S_ISDIR(info.st_mode)) throw std::runtime_error(path + ": is a directory, expected a file");
  constexpr std::size_t least_room = std::size_t{1} << 16, most_of_a_device = std::size_t{1} << 30;
  std::string bytes(static_cast<std::size_t>(info.st_size) + least_room, '\0');
  std::size_t size = 0;
  for (;;) {
    const ssize_t got = ::read(file.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (S_ISCHR(info.st_mode) && size > most_of_a_device)
      throw std::runtime_error(path + ": is a device that does not end within 1 GiB, expected a file");
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  bytes.resize(size);
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace plumb
