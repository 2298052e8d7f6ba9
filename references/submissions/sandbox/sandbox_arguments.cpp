#include "references/submissions/sandbox/sandbox_arguments.hpp"

#include <sys/resource.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "references/submissions/sandbox/control_group.hpp"
#include "references/submissions/sandbox/shown_places.hpp"

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void add(Words& to, const Words& words) { to.insert(to.end(), words.begin(), words.end()); }

/// A program writes to /tmp only, apart from shared memory. Its size is a limit that the kernel keeps.
Words own(const std::string& path, const std::string& bytes) {
  if (path == "/proc") return {"--proc", path};
  if (path == "/tmp") return {"--perms", "1777", "--size", bytes, "--tmpfs", path};
  return {"--dev", path,      "--perms",     "1777",  "--size",
          bytes,   "--tmpfs", path + "/shm", "--dir", sign_of_setup};
}

Words mounts_of(const Place& place, const std::string& bytes) {
  switch (place.kind) {
    case PlaceKind::shown:
      return {"--ro-bind-try", place.path, place.path};
    case PlaceKind::link:
      return {"--symlink", place.target, place.path};
    case PlaceKind::way:
      return {"--perms", "0755", "--dir", place.path};
    case PlaceKind::own:
      return own(place.path, bytes);
    case PlaceKind::hidden:
      break;
  }
  if (fs::is_directory(place.path)) return {"--tmpfs", place.path};
  return {"--ro-bind", "/dev/null", place.path};
}

void add_mounts(Words& all, const SandboxView& view, const SandboxLimits& limits) {
  const std::string bytes = std::to_string(limits.disk_bytes);
  const std::vector<Place> places = places_of(view);
  for (const Place& place : places) add(all, mounts_of(place, bytes));
  add(all, {"--perms", "0777", "--dir", sandbox_directory});
  for (const Place& place : places)
    if (place.kind == PlaceKind::hidden && fs::is_directory(place.path))
      add(all, {"--remount-ro", place.path});
  add(all, {"--remount-ro", "/dev", "--remount-ro", "/"});
}

/// True since Linux 5.14: the kernel counts the processes of a user namespace for itself.
bool are_namespaces_counted() {
  utsname kernel{};
  int major = 0, minor = 0;
  return uname(&kernel) == 0 && std::sscanf(kernel.release, "%d.%d", &major, &minor) == 2 &&
         (major > 5 || (major == 5 && minor >= 14));
}

/// A limit behind the watcher's, in case that is late: the fewer processes it lets through, the sooner the
/// watcher gets its turn. Where the kernel counts all processes of our user, she has some already.
std::string most_processes(const SandboxLimits& limits, unsigned user) {
  rlimit now{};
  getrlimit(RLIMIT_NPROC, &now);
  const rlim_t already = user == 0 && !are_namespaces_counted() ? 1024 : 0;
  return std::to_string(std::min<rlim_t>(2 * most_tasks(limits) + already, now.rlim_max));
}

}  // namespace

std::vector<std::string> sandbox_arguments(const std::string& bwrap, const std::vector<std::string>& command,
                                           const SandboxView& view, const SandboxLimits& limits,
                                           unsigned user) {
  Words all{bwrap, "--die-with-parent", "--new-session", "--clearenv", "--cap-drop", "ALL"};
  add(all, {"--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try"});
  if (user == 0)
    add(all, {"--unshare-user", "--disable-userns"});
  else
    add(all, {"--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"});
  add(all, {"--json-status-fd", std::to_string(status_descriptor)});
  add(all, {"--block-fd", std::to_string(release_descriptor)});
  add(all, {"--seccomp", std::to_string(filter_descriptor)});
  add_mounts(all, view, limits);
  add(all, {"--setenv", "PATH", "/usr/local/bin:/usr/bin:/bin", "--setenv", "HOME", sandbox_directory});
  add(all, {"--setenv", "TMPDIR", "/tmp", "--setenv", "LC_ALL", "C.UTF-8"});
  add(all, {"--chdir", sandbox_directory, "--"});
  add(all, {"/usr/bin/prlimit", "--nproc=" + most_processes(limits, user), "--"});
  add(all, {"/usr/bin/setpriv", "--no-new-privs"});
  const std::string id = std::to_string(user);
  if (user != 0) add(all, {"--reuid", id, "--regid", id, "--clear-groups"});
  add(all, {"--"});
  add(all, command);
  return all;
}

}  // namespace plumb::submissions
