// What a process and all that it started take at a moment, read from /proc.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace plumb::references {

struct TreeUsage {
  std::size_t processes = 0;     ///< descendants, the process itself not counted
  std::size_t memory_bytes = 0;  ///< resident, of all together; what they share counts for each
  double cpu_seconds = 0;        ///< of those alive and of those that they have waited for
};

/// A process that ends while it is looked at counts or not.
TreeUsage usage_below(pid_t root);

/// Those whose parent it is.
std::vector<pid_t> children_of(pid_t parent);

}  // namespace plumb::references
