#include "tracer/system/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <stdexcept>

#include "tracer/system/leftovers.hpp"

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

/// Returns a short name in the same directory. Clears that directory of what killed runs left.
std::string path_aside(const std::string& path) {
  std::random_device random;
  const std::size_t slash = path.find_last_of('/');
  const std::string directory = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  remove_leftovers(directory.empty() ? "." : directory);
  return directory + "." + temporary_name() + std::to_string(random()) + std::to_string(random());
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path == "-" ? "standard output" : path) {
  if (path == "-") return;
  int flags = O_WRONLY | O_CLOEXEC;
  if (!is_special(path)) {
    aside_ = path_aside(path);
    on_signal_.emplace(aside_);
    flags |= O_CREAT | O_EXCL;
  }
  constexpr mode_t readable_by_all = 0666;
  file_.emplace(::open(is_aside() ? aside_.c_str() : path.c_str(), flags, readable_by_all));
  if (file_->number() < 0) fail(path_, errno);
  if (is_aside()) claim_temporary(file_->number());
}

OutputFile::~OutputFile() {
  if (is_aside()) ::unlink(aside_.c_str());
}

void OutputFile::keep(std::string_view bytes) {
  const auto at = static_cast<std::size_t>(position_);
  kept_.resize(std::max(kept_.size(), at));
  kept_.replace(at, bytes.size(), bytes);
}

void OutputFile::write(std::string_view bytes) {
  if (is_aside()) {
    write_all(file_->number(), bytes, path_);
  } else {
    keep(bytes);
  }
  position_ += bytes.size();
}

void OutputFile::seek(std::uint64_t position) {
  if (is_aside() && ::lseek(file_->number(), static_cast<off_t>(position), SEEK_SET) < 0) fail(path_, errno);
  position_ = position;
}

void OutputFile::put_in_place() {
  if (::fsync(file_->number()) != 0) fail(path_, errno);
  if (std::rename(aside_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  aside_.clear();
}

void OutputFile::commit() {
  if (is_aside()) {
    put_in_place();
  } else {
    write_all(file_ ? file_->number() : STDOUT_FILENO, kept_, path_);
  }
}

}  // namespace plumb
