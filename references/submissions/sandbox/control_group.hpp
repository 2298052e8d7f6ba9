// The kernel's own account of all processes of a run (cgroup v2). It counts what they share, what they leave
// in memory and what ended long ago, too.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::submissions {

/// Returns the most threads and processes at once. A program may have a thread for each core, and more.
std::size_t most_tasks(const SandboxLimits& limits);

/// What control groups that we make can do here.
struct ControlGroups {
  std::string parent;         ///< the directory in which ours are made; empty when there is none
  bool keeps_memory = false;  ///< they keep limits of memory
  bool keeps_tasks = false;   ///< they keep limits of processes and threads
};

/// Looks once for the nearest group around us that keeps both for those within it and lets us make one and
/// enter it. Else takes the nearest that lets us, which still counts CPU time.
const ControlGroups& control_groups();

/// A group for one run, removed at the end of its scope. It does nothing where none can be made.
class ControlGroup {
 public:
  explicit ControlGroup(const SandboxLimits& limits);
  ~ControlGroup();
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;

  /// A process enters by writing 0 to this descriptor; -1 when there is no group.
  int entrance() const { return entrance_.number(); }
  std::optional<double> cpu_seconds() const;
  bool ran_out_of_memory() const;
  bool ran_out_of_tasks() const;

 private:
  std::optional<double> value(const std::string& file, const std::string& key) const;

  std::string directory_;
  Descriptor entrance_;
};

}  // namespace plumb::submissions
