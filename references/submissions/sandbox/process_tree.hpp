// Reads from /proc what a process and all that it started take at a moment.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <map>
#include <vector>

namespace plumb::submissions {

/// One process of a tree.
struct TreeMember {
  pid_t id = 0;
  double begin_ticks = 0;  ///< when it began, which tells it from others that had its number
  double cpu_seconds = 0;  ///< its own
};

struct TreeUsage {
  std::vector<TreeMember> members;
  std::size_t processes = 0;     ///< number of descendants, without the process itself
  std::size_t threads = 0;       ///< number of their threads
  std::size_t memory_bytes = 0;  ///< resident, of all together; what they share counts for each
  double cpu_seconds = 0;        ///< of those alive and of those for which they have waited
};

/// Returns what the descendants of `root` take. A process that ends meanwhile counts or not.
TreeUsage usage_below(pid_t root);

/// True if a thread of theirs computes, or would if a core were free.
bool is_any_runnable(const std::vector<TreeMember>& members);

/// Returns the memory that no process has resident: page tables, and the full length of mapped anonymous
/// shared memory.
std::size_t unseen_memory(const std::vector<TreeMember>& members);

/// Returns what they have resident: what they share counts once, shared memory not at all. Takes long.
std::size_t private_memory(const std::vector<TreeMember>& members);

/// Adds up the CPU time of a tree over its life, as far as it is seen from time to time. It includes children
/// that nobody waited for.
class TreeClock {
 public:
  /// Returns the seconds until now.
  double after(const TreeUsage& usage);

 private:
  std::map<std::pair<pid_t, double>, double> seen_;
};

}  // namespace plumb::submissions
