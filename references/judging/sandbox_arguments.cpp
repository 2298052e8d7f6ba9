#include "references/judging/sandbox_arguments.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace plumb::references {
namespace {

namespace fs = std::filesystem;

constexpr const char* own_bytes = "67108864";  // of /tmp and of /dev/shm, 64 MiB each

void add(std::vector<std::string>& to, std::initializer_list<std::string> words) {
  to.insert(to.end(), words);
}

bool lies_in(const std::string& path, const std::string& directory) {
  return path == directory || path.starts_with(directory + "/");
}

}  // namespace

std::vector<std::string> hidden_places() {
  std::vector<std::string> places{"/home", "/root", "/tmp", "/var/tmp", "/run", "/mnt", "/media"};
  if (const char* home = std::getenv("HOME"); home != nullptr && fs::path(home).is_absolute()) {
    std::error_code none;
    const fs::path real = fs::canonical(home, none);
    if (!none && real != "/") places.push_back(real.string());
  }
  std::erase_if(places, [](const std::string& p) { return !fs::is_directory(fs::symlink_status(p)); });
  return places;
}

bool is_hidden(const std::string& path) {
  const auto places = hidden_places();
  return std::any_of(places.begin(), places.end(), [&](const auto& p) { return lies_in(path, p); });
}

std::vector<std::string> sandbox_arguments(const std::string& bwrap, const std::vector<std::string>& command,
                                           const SandboxView& view) {
  std::vector<std::string> all{bwrap,        "--die-with-parent", "--new-session",
                               "--clearenv", "--cap-drop",        "ALL"};
  add(all, {"--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try"});
  if (view.user == 0)
    add(all, {"--unshare-user"});
  else
    add(all, {"--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"});
  add(all, {"--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev"});
  add(all, {"--size", own_bytes, "--tmpfs", "/dev/shm", "--remount-ro", "/dev"});
  std::vector<std::string> hidden = hidden_places();
  hidden.insert(hidden.end(), view.hidden.begin(), view.hidden.end());
  for (const std::string& place : hidden) add(all, {"--size", own_bytes, "--tmpfs", place});
  for (const std::string& path : view.readable) {
    for (std::size_t at = path.find('/', 1); at != std::string::npos; at = path.find('/', at + 1))
      if (is_hidden(path.substr(0, at))) add(all, {"--perms", "0755", "--dir", path.substr(0, at)});
    add(all, {"--ro-bind", path, path});
  }
  add(all, {"--bind", view.writable, sandbox_directory});
  for (const std::string& place : hidden)
    if (!lies_in(sandbox_directory, place)) add(all, {"--remount-ro", place});
  add(all, {"--setenv", "PATH", "/usr/local/bin:/usr/bin:/bin", "--setenv", "HOME", sandbox_directory});
  add(all, {"--setenv", "TMPDIR", "/tmp", "--setenv", "LC_ALL", "C.UTF-8"});
  add(all,
      {"--chdir", view.user == 0 ? sandbox_directory : "/", "--"});  // root without its rights may not enter
  const std::string id = std::to_string(view.user);
  if (view.user != 0)
    add(all, {"/usr/bin/setpriv", "--reuid", id, "--regid", id, "--clear-groups", "--no-new-privs", "--",
              "/usr/bin/env", "-C", sandbox_directory});
  all.insert(all.end(), command.begin(), command.end());
  return all;
}

}  // namespace plumb::references
