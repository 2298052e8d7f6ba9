#include "references/renderers/unasked_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "references/renderers/cache.hpp"
#include "references/system/digest.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/words.hpp"

namespace plumb::renderers {
namespace {

namespace fs = std::filesystem;

/// Empty when there is no such regular file. Writing to it or putting another in its place changes this.
std::string identity_of(const std::string& path) {
  struct stat info {};
  if (::lstat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return {};
  const auto time = [](const timespec& t) {
    return std::to_string(t.tv_sec) + "." + std::to_string(t.tv_nsec);
  };
  return std::to_string(info.st_dev) + " " + std::to_string(info.st_ino) + " " +
         std::to_string(info.st_size) + " " + time(info.st_mtim) + " " + time(info.st_ctim) + "\n";
}

std::string memory_of(const std::string& path) {
  return Cache().directory() + "/written-" + system::sha256(fs::absolute(path).lexically_normal().string());
}

void remember(const std::string& path) {
  try {
    fs::create_directories(Cache().directory());
    write_file(memory_of(path), identity_of(path));
  } catch (const std::exception&) {
    // The next run then takes the file for somebody else's, and says what to do.
  }
}

bool is_plumbs(const std::string& path) {
  try {
    const std::string identity = identity_of(path);
    return !identity.empty() && fs::exists(memory_of(path)) && read_file(memory_of(path)) == identity;
  } catch (const std::exception&) {
    return false;
  }
}

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error(
      in_quotes(path) +
      " is there already, and no render without -o wrote it, or it was changed since: it is left "
      "as it is; to replace it, or to write another file, name the image with -o");
}

bool is_there(const std::string& path) {
  struct stat info {};
  return ::lstat(path.c_str(), &info) == 0;
}

/// 0, or the error: EEXIST when the name is taken.
int rename_to_new(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  const bool is_unknown = errno == EINVAL || errno == ENOSYS;  // to this file system
  return is_unknown && ::link(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

std::string directory_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

const std::string& checked(const std::string& path) {
  if (is_there(path) && !is_plumbs(path)) refuse(path);
  return path;
}

}  // namespace

UnaskedFile::UnaskedFile(const std::string& path) : path_(checked(path)), directory_(directory_of(path)) {}

std::string UnaskedFile::aside() const {
  return (fs::path(directory_.path()) / fs::path(path_).filename()).string();
}

void UnaskedFile::put_in_place() const {
  int error = rename_to_new(aside(), path_);
  if (error == EEXIST) {
    if (!is_plumbs(path_)) refuse(path_);
    error = std::rename(aside().c_str(), path_.c_str()) == 0 ? 0 : errno;
  }
  if (error != 0) throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(error));
  remember(path_);
}

}  // namespace plumb::renderers
