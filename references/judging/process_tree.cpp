#include "references/judging/process_tree.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace plumb::references {
namespace {

struct ProcessState {
  pid_t id;
  pid_t parent;
  double ticks;
  std::size_t pages;
};

/// proc(5), /proc/pid/stat: fields 4 ppid, 14..17 utime stime cutime cstime, 24 rss; the name before them may
/// hold blanks and parentheses.
std::optional<ProcessState> state_of(pid_t id) {
  const int file = open(("/proc/" + std::to_string(id) + "/stat").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  char text[1024];
  const ssize_t size = read(file, text, sizeof text - 1);
  close(file);
  if (size <= 0) return std::nullopt;
  text[size] = '\0';
  char* at = std::strrchr(text, ')');
  if (at == nullptr) return std::nullopt;
  at += 3;  // over ") " and the state
  double field[25] = {};
  for (int i = 4; i < 25; ++i) field[i] = std::strtod(at, &at);
  return ProcessState{id, static_cast<pid_t>(field[4]), field[14] + field[15] + field[16] + field[17],
                      static_cast<std::size_t>(field[24])};
}

std::vector<ProcessState> all_processes() {
  std::vector<ProcessState> all;
  const std::unique_ptr<DIR, int (*)(DIR*)> directory(opendir("/proc"), closedir);
  if (!directory) return all;
  while (const dirent* entry = readdir(directory.get())) {
    if (std::isdigit(static_cast<unsigned char>(entry->d_name[0])) == 0) continue;
    if (const auto state = state_of(std::atoi(entry->d_name))) all.push_back(*state);
  }
  return all;
}

}  // namespace

TreeUsage usage_below(pid_t root) {
  const std::vector<ProcessState> all = all_processes();
  std::set<pid_t> members{root};
  std::size_t before = 0;
  while (before != members.size()) {  // numbers wrap around, so a child may come before its parent
    before = members.size();
    for (const ProcessState& p : all)
      if (members.contains(p.parent)) members.insert(p.id);
  }
  TreeUsage usage;
  for (const ProcessState& p : all) {
    if (p.id == root || !members.contains(p.id)) continue;
    ++usage.processes;
    usage.memory_bytes += p.pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    usage.cpu_seconds += p.ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  return usage;
}

std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (const ProcessState& p : all_processes())
    if (p.parent == parent) children.push_back(p.id);
  return children;
}

}  // namespace plumb::references
