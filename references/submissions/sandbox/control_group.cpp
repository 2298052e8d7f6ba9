#include "references/submissions/sandbox/control_group.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;

constexpr const char* name_prefix = "plumb-";

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

bool write_to(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  return out.good();
}

/// proc(5), /proc/pid/mountinfo: field 4 is the root of the mount, 5 where it is mounted; the type comes
/// behind " - ".
fs::path mount_point() {
  std::istringstream lines(text_of("/proc/self/mountinfo"));
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" - cgroup2 ") == std::string::npos) continue;
    std::istringstream words(line);
    std::string skipped, root, point;
    words >> skipped >> skipped >> skipped >> root >> point;
    if (root == "/") return point;
  }
  return {};
}

/// The directory of the group that we are in; empty when there is none.
fs::path own_group() {
  const fs::path top = mount_point();
  std::istringstream lines(text_of("/proc/self/cgroup"));
  for (std::string line; !top.empty() && std::getline(lines, line);)
    if (line.starts_with("0::/")) return (top / line.substr(4)).lexically_normal();
  return {};
}

/// Removes the groups of killed runs whose process is gone. A group that still has processes cannot be
/// removed.
void remove_left_behind(const fs::path& parent) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(parent, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(name_prefix)) continue;
    const auto owner = static_cast<int>(
        std::strtol(name.c_str() + std::char_traits<char>::length(name_prefix), nullptr, 10));
    if (owner > 0 && kill(owner, 0) != 0 && errno == ESRCH) rmdir(entry.path().c_str());
  }
}

bool can_enter(const fs::path& group) {
  const int entrance = open((group / "cgroup.procs").c_str(), O_WRONLY | O_CLOEXEC);
  if (entrance < 0) return false;
  const pid_t child = fork();
  if (child == 0) _exit(write(entrance, "0", 1) == 1 ? 0 : 1);
  int status = 1;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  close(entrance);
  return status == 0;
}

bool works_in(const fs::path& parent) {
  const fs::path group = parent / (name_prefix + std::to_string(getpid()) + "-try");
  if (mkdir(group.c_str(), 0755) != 0) return false;
  const bool works = can_enter(group);
  rmdir(group.c_str());
  return works;
}

ControlGroups found_groups() {
  ControlGroups found;
  const fs::path top = mount_point();
  for (fs::path at = own_group(); !top.empty() && !at.empty(); at = at.parent_path()) {
    const std::string given = " " + text_of(at / "cgroup.subtree_control");
    const bool keeps_memory = given.find("memory") != std::string::npos;
    if ((found.parent.empty() || (keeps_memory && !found.keeps_memory)) && works_in(at))
      found = {at.string(), keeps_memory, given.find("pids") != std::string::npos};
    if (at == top) break;
  }
  if (!found.parent.empty()) remove_left_behind(found.parent);
  return found;
}

std::string new_group() {
  static std::atomic<unsigned> next = 0;
  if (control_groups().parent.empty()) return {};
  std::string path =
      control_groups().parent + "/" + name_prefix + std::to_string(getpid()) + "-" + std::to_string(next++);
  return mkdir(path.c_str(), 0755) == 0 ? path : std::string();
}

}  // namespace

std::size_t most_tasks(const SandboxLimits& limits) {
  return 4 * limits.processes + 2 * std::thread::hardware_concurrency();
}

const ControlGroups& control_groups() {
  static const ControlGroups found = found_groups();
  return found;
}

ControlGroup::ControlGroup(const SandboxLimits& limits)
    : directory_(new_group()),
      entrance_(directory_.empty() ? -1
                                   : open((directory_ + "/cgroup.procs").c_str(), O_WRONLY | O_CLOEXEC)) {
  const fs::path at = directory_;
  if (control_groups().keeps_memory) {
    write_to(at / "memory.max", std::to_string(limits.memory_bytes));
    write_to(at / "memory.swap.max", "0");
    write_to(at / "memory.oom.group", "1");
  }
  if (control_groups().keeps_tasks) write_to(at / "pids.max", std::to_string(most_tasks(limits)));
}

ControlGroup::~ControlGroup() {
  if (!directory_.empty()) rmdir(directory_.c_str());
}

std::optional<double> ControlGroup::value(const std::string& file, const std::string& key) const {
  if (directory_.empty()) return std::nullopt;
  std::istringstream words(text_of(fs::path(directory_) / file));
  std::string name;
  for (double number = 0; words >> name >> number;)
    if (name == key) return number;
  return std::nullopt;
}

std::optional<double> ControlGroup::cpu_seconds() const {
  const std::optional<double> microseconds = value("cpu.stat", "usage_usec");
  return microseconds ? std::optional(*microseconds / 1e6) : std::nullopt;
}

bool ControlGroup::ran_out_of_memory() const { return value("memory.events", "oom_kill").value_or(0) > 0; }

bool ControlGroup::ran_out_of_tasks() const { return value("pids.events", "max").value_or(0) > 0; }

}  // namespace plumb::submissions
