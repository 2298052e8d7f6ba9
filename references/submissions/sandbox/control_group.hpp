// The kernel's own account of all processes of a run (cgroup v2): what they share, what they leave in memory
// and what ended long ago is counted, too.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::references {

/// Threads and processes at once: a program may have a thread for each core, and more.
std::size_t most_tasks(const SandboxLimits& limits);

/// What groups that we make can do here.
struct ControlGroups {
  std::string parent;         ///< the directory that ours are made in; empty when there is none
  bool keeps_memory = false;  ///< limits of memory are kept
  bool keeps_tasks = false;   ///< limits of processes and threads are kept
};

/// Looked for once: the nearest group around us that keeps both for those within it and lets us make one and
/// enter it; else the nearest that lets us, which still counts CPU time.
const ControlGroups& control_groups();

/// A group for one run, removed at the end of its scope; does nothing where none can be made.
class ControlGroup {
 public:
  explicit ControlGroup(const SandboxLimits& limits);
  ~ControlGroup();
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;

  /// A process enters by writing 0 to it; -1 when there is no group.
  int entrance() const { return entrance_.number(); }
  std::optional<double> cpu_seconds() const;
  bool ran_out_of_memory() const;
  bool ran_out_of_tasks() const;

 private:
  std::optional<double> value(const std::string& file, const std::string& key) const;

  std::string directory_;
  Descriptor entrance_;
};

}  // namespace plumb::references
