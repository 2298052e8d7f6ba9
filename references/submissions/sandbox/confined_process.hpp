// A process in its sandbox, from its start by bubblewrap to its end.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "references/submissions/sandbox/control_group.hpp"
#include "references/submissions/sandbox/sandbox.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::submissions {

/// Returns the path of bubblewrap. Throws std::runtime_error, saying what to install, when there is none.
std::string found_bubblewrap();

/// It is killed at the end of its scope, with all that it started.
class ConfinedProcess {
 public:
  /// Sets the sandbox up, copies the given files into it, and keeps the program waiting for begin(). Throws
  /// std::runtime_error with what bubblewrap says.
  ConfinedProcess(const std::vector<std::string>& command, const SandboxView& view,
                  const SandboxLimits& limits, const ControlGroup& group);
  ~ConfinedProcess();
  ConfinedProcess(const ConfinedProcess&) = delete;
  ConfinedProcess& operator=(const ConfinedProcess&) = delete;

  void begin();
  /// True once it has ended.
  bool has_ended();
  /// Kills the first process of the namespace. The kernel then ends all others before bubblewrap learns of
  /// it.
  void kill_all() const;
  /// Waits until none of its processes is left.
  void wait_for_the_last() const;
  /// Returns how the program ended, as a shell tells it: 128 + the number of a signal. -1 when it did not
  /// begin, or was killed with bubblewrap.
  int exit_code();

  pid_t bubblewrap() const { return bubblewrap_; }
  /// Descriptor of its standard output and error; reading it does not block.
  int output() const { return output_->number(); }
  /// Returns `sandbox_directory` as the program sees it, opened.
  const std::shared_ptr<const Descriptor>& directory() const { return directory_; }
  /// The memory that its files take, those without a name included, and the number of files.
  struct Disk {
    std::size_t bytes = 0, free_bytes = 0, files = 0;
  };
  Disk disk() const;

 private:
  void wait_for_setup();
  bool opened_directory();
  void read_status();
  void end();

  pid_t bubblewrap_ = -1;
  pid_t first_ = 0;  ///< first process of the namespace
  bool is_over_ = false;
  std::unique_ptr<Descriptor> output_, status_, release_, first_handle_, shared_memory_;
  std::shared_ptr<const Descriptor> directory_;
  std::string status_text_;
};

}  // namespace plumb::submissions
