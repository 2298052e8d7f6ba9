#include "references/submissions/sandbox/process_tree.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>

namespace plumb::submissions {
namespace {

struct ProcessState {
  pid_t id;
  pid_t parent;
  double own_ticks;
  double ticks;  ///< with those of the children that it has waited for
  std::size_t threads;
  double begin_ticks;
  std::size_t pages;
};

/// proc(5), /proc/pid/stat: fields 4 ppid, 14..17 utime stime cutime cstime, 20 num_threads, 22 starttime, 24
/// rss; the name before them may hold blanks and parentheses.
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
  const double own = field[14] + field[15];
  return ProcessState{id,
                      static_cast<pid_t>(field[4]),
                      own,
                      own + field[16] + field[17],
                      static_cast<std::size_t>(field[20]),
                      field[22],
                      static_cast<std::size_t>(field[24])};
}

std::vector<ProcessState> all_processes() {
  std::vector<ProcessState> all;
  const std::unique_ptr<DIR, int (*)(DIR*)> directory(opendir("/proc"), closedir);
  if (!directory) return all;
  while (const dirent* entry = readdir(directory.get())) {
    if (std::isdigit(static_cast<unsigned char>(entry->d_name[0])) == 0) continue;
    if (const auto state = state_of(static_cast<int>(std::strtol(entry->d_name, nullptr, 10))))
      all.push_back(*state);
  }
  return all;
}

double seconds_of(double ticks) { return ticks / static_cast<double>(sysconf(_SC_CLK_TCK)); }

/// KiB of the line of a file of /proc that begins with the key, in bytes; 0 when there is none.
std::size_t bytes_of_line(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10) << 10;
  return 0;
}

std::string file_of(const TreeMember& member, const char* name) {
  return "/proc/" + std::to_string(member.id) + "/" + name;
}

std::vector<std::string> threads_of(const TreeMember& member) {
  std::vector<std::string> all;
  std::error_code gone;
  std::filesystem::directory_iterator at(file_of(member, "task"), gone);
  for (; !gone && at != std::filesystem::directory_iterator(); at.increment(gone))
    all.push_back(at->path().string());
  return all;
}

/// proc(5), /proc/pid/task/tid/stat: the state stands behind the name, which may hold parentheses.
bool is_runnable(const std::string& thread) {
  std::string text;
  std::getline(std::ifstream(thread + "/stat"), text, '\0');
  const std::size_t end_of_name = text.rfind(')');
  return end_of_name != std::string::npos && text.substr(end_of_name, 3) == ") R";
}

using SharedLengths = std::map<std::string, std::size_t>;

/// proc(5), /proc/pid/maps: range, rights, offset, device, inode, name. Anonymous shared memory is a file of
/// its own, named as below.
void add_shared_lengths(const TreeMember& member, SharedLengths& lengths) {
  std::ifstream in(file_of(member, "maps"));
  for (std::string line; std::getline(in, line);) {
    if (!line.ends_with("/dev/zero (deleted)")) continue;
    std::istringstream words(line);
    std::size_t begin = 0, end = 0, offset = 0;
    char dash = 0;
    std::string rights, device, inode;
    words >> std::hex >> begin >> dash >> end >> rights >> offset >> device >> inode;
    std::size_t& length = lengths[inode];
    length = std::max(length, offset + end - begin);
  }
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
    usage.members.push_back({p.id, p.begin_ticks, seconds_of(p.own_ticks)});
    ++usage.processes;
    usage.threads += p.threads;
    usage.memory_bytes += p.pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    usage.cpu_seconds += seconds_of(p.ticks);
  }
  return usage;
}

bool is_any_runnable(const std::vector<TreeMember>& members) {
  return std::any_of(members.begin(), members.end(), [](const TreeMember& member) {
    const std::vector<std::string> threads = threads_of(member);
    return std::any_of(threads.begin(), threads.end(), is_runnable);
  });
}

std::size_t unseen_memory(const std::vector<TreeMember>& members) {
  std::size_t bytes = 0;
  SharedLengths lengths;
  for (const TreeMember& member : members) {
    bytes += bytes_of_line(file_of(member, "status"), "VmPTE:");
    add_shared_lengths(member, lengths);
  }
  for (const auto& [inode, length] : lengths) bytes += length;
  return bytes;
}

std::size_t private_memory(const std::vector<TreeMember>& members) {
  std::size_t bytes = 0;
  for (const TreeMember& member : members) {
    const std::string file = file_of(member, "smaps_rollup");
    bytes += bytes_of_line(file, "Pss:") - bytes_of_line(file, "Pss_Shmem:");
  }
  return bytes;
}

double TreeClock::after(const TreeUsage& usage) {
  for (const TreeMember& member : usage.members) {
    double& seconds = seen_[{member.id, member.begin_ticks}];
    seconds = std::max(seconds, member.cpu_seconds);
  }
  double all = 0;
  for (const auto& [process, seconds] : seen_) all += seconds;
  return std::max(all, usage.cpu_seconds);
}

}  // namespace plumb::submissions
