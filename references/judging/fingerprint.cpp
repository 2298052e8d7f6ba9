#include "references/judging/fingerprint.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace plumb::references {
namespace {

namespace fs = std::filesystem;

std::string time_text(const timespec& time) {
  return std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec);
}

std::string entry(const std::string& path) {
  struct stat info {};
  const bool is_seen = lstat(path.c_str(), &info) == 0;
  std::string text = path;
  text += is_seen ? '\0' : '?';
  for (const std::string& part :
       {std::to_string(info.st_mode), std::to_string(info.st_size), std::to_string(info.st_ino),
        time_text(info.st_mtim), time_text(info.st_ctim)})
    text += part + " ";
  return text;
}

}  // namespace

std::string fingerprint_of(const std::string& path) {
  struct stat info {};
  if (lstat(path.c_str(), &info) != 0)
    throw std::runtime_error(path + ": cannot be looked at: " + std::strerror(errno));
  std::string text = entry(path);
  if (!fs::is_directory(fs::symlink_status(path))) return text;
  std::vector<std::string> below;
  for (const auto& one :
       fs::recursive_directory_iterator(path, fs::directory_options::skip_permission_denied))
    below.push_back(one.path().string());
  std::sort(below.begin(), below.end());
  for (const std::string& one : below) text += entry(one);
  return text;
}

}  // namespace plumb::references
