// Runs programs of people we do not know, confined with bubblewrap: no network, nothing to write but one
// directory, no home, no processes but their own, and limits that are kept.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tracer/system/descriptor.hpp"

namespace plumb::submissions {

struct SandboxLimits {
  double wall_seconds = 10;
  double cpu_seconds = 20;                          ///< of all its processes together
  std::size_t memory_bytes = std::size_t{2} << 30;  ///< of all its processes and files together
  std::size_t processes = 64;                       ///< at most at once, those of the sandbox included
  /// The limit of all that it writes, also of shared memory, and also of standard output and error.
  std::size_t disk_bytes = std::size_t{64} << 20;
  std::size_t files = 1024;  ///< at most at once, directories included
};

enum class Ending { finished, timed_out, too_much_cpu, too_much_memory, too_many_processes, too_much_output };

struct SandboxRun {
  Ending ending = Ending::finished;
  int exit_code = 0;         ///< valid when it finished
  int signal = 0;            ///< for which its exit code, 128 and more, may stand; else 0
  bool was_starved = false;  ///< it timed out, still had to compute, and had got little CPU time
  double wall_seconds = 0;
  std::string printed;       ///< the first 16 KiB of standard output and error
  std::string not_executed;  ///< why the program itself never began; empty when it did

  /// The path of what stood in `sandbox_directory` at the end. It is valid as long as this or a copy lives.
  std::string directory() const;
  std::shared_ptr<const Descriptor> left;
};

/// What a run sees besides the system's programs, libraries and a few of its settings.
struct SandboxView {
  std::string given;  ///< host directory: its files are copied into `sandbox_directory`; may be empty
  std::vector<std::string> readable;  ///< paths that it sees as they are
  std::vector<std::string> hidden;    ///< paths within these that it does not see
};

/// Where a confined program runs. It lies in a /tmp of its own that is lost with it.
inline constexpr const char* sandbox_directory = "/tmp/judged";

/// Runs /bin/true in this view. Throws std::runtime_error, saying what to do, when bubblewrap is missing, may
/// not make namespaces, or cannot make this view. `program`, unless it is empty, must exist in it.
void require_sandbox(const SandboxView& view = {}, const std::string& program = {});

/// Returns the limits that the kernel does not keep on this machine, and what is done instead; empty when it
/// keeps all.
std::string limits_not_enforced();

/// Runs a command, and never unconfined. When it returns, no process of the run is left. Throws
/// std::runtime_error when the sandbox itself fails, which says nothing about the program.
SandboxRun run_confined(const std::vector<std::string>& command, const SandboxView& view,
                        const SandboxLimits& limits);

}  // namespace plumb::submissions
