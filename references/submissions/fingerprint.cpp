#include "references/submissions/fingerprint.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

namespace plumb::submissions {
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
  if (S_ISDIR(info.st_mode))
    return text + std::to_string(info.st_mode) + " " + std::to_string(info.st_ino) + " ";
  for (const std::string& part :
       {std::to_string(info.st_mode), std::to_string(info.st_size), std::to_string(info.st_ino),
        time_text(info.st_mtim), time_text(info.st_ctim)})
    text += part + " ";
  return text;
}

using Identity = std::pair<dev_t, ino_t>;

Identity identity_of(const struct stat& info) { return {info.st_dev, info.st_ino}; }

std::set<Identity> identities_of(const std::vector<std::string>& paths) {
  std::set<Identity> all;
  struct stat info {};
  for (const std::string& path : paths)
    if (stat(path.c_str(), &info) == 0) all.insert(identity_of(info));
  return all;
}

}  // namespace

std::string fingerprint_of(const std::string& path, const std::vector<std::string>& left_out) {
  struct stat info {};
  if (lstat(path.c_str(), &info) != 0)
    throw std::runtime_error(path + ": cannot be looked at: " + std::strerror(errno));
  std::string text = entry(path);
  if (!fs::is_directory(fs::symlink_status(path))) return text;
  const std::set<Identity> out = identities_of(left_out);
  std::vector<std::string> below;
  for (fs::recursive_directory_iterator at(path, fs::directory_options::skip_permission_denied), end;
       at != end; ++at) {
    const std::string one = at->path().string();
    if (lstat(one.c_str(), &info) == 0 && out.contains(identity_of(info)))
      at.disable_recursion_pending();
    else
      below.push_back(one);
  }
  std::sort(below.begin(), below.end());
  for (const std::string& one : below) text += entry(one);
  return text;
}

}  // namespace plumb::submissions
