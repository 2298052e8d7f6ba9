// What a process and all that it started take at a moment, read from /proc.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <map>
#include <vector>

namespace plumb::references {

/// One process of a tree.
struct TreeMember {
  pid_t id = 0;
  double begin_ticks = 0;  ///< when it began, which tells it from others of its number
  double cpu_seconds = 0;  ///< its own
};

struct TreeUsage {
  std::vector<TreeMember> members;
  std::size_t processes = 0;     ///< descendants, the process itself not counted
  std::size_t threads = 0;       ///< of those
  std::size_t memory_bytes = 0;  ///< resident, of all together; what they share counts for each
  double cpu_seconds = 0;        ///< of those alive and of those that they have waited for
};

/// A process that ends while it is looked at counts or not.
TreeUsage usage_below(pid_t root);

/// Whether a thread of theirs computes, or would if a core were free.
bool is_any_runnable(const std::vector<TreeMember>& members);

/// What no process has resident: page tables, and anonymous shared memory in the whole length that is mapped.
std::size_t unseen_memory(const std::vector<TreeMember>& members);

/// What they have resident, what they share counted once; shared memory not at all. Takes long.
std::size_t private_memory(const std::vector<TreeMember>& members);

/// The CPU time of a tree over its life, as far as it is seen from time to time: also of children that nobody
/// waited for.
class TreeClock {
 public:
  /// Seconds until now.
  double after(const TreeUsage& usage);

 private:
  std::map<std::pair<pid_t, double>, double> seen_;
};

}  // namespace plumb::references
