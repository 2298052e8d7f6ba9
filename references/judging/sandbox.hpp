// Programs of people we do not know, confined with bubblewrap: no network, nothing to write but one
// directory, no home, no processes but their own, and limits that are watched.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plumb::references {

struct SandboxLimits {
  double wall_seconds = 10;
  double cpu_seconds = 20;  ///< of all its processes together
  std::size_t memory_bytes = std::size_t{2} << 30;
  std::size_t processes = 64;                        ///< at once, those of the sandbox included
  std::size_t disk_bytes = std::size_t{64} << 20;    ///< of all files that it leaves, and of any one
  std::size_t files = 256;                           ///< that it leaves
  std::size_t printed_bytes = std::size_t{1} << 20;  ///< on standard output and error
};

enum class Ending { finished, timed_out, too_much_cpu, too_much_memory, too_many_processes, too_much_output };

struct SandboxRun {
  Ending ending = Ending::finished;
  int exit_code = 0;  ///< valid when it finished without a signal
  int signal = 0;
  double wall_seconds = 0;
  std::string printed;  ///< the first 16 KiB of standard output and error
};

/// What a run may see of the places that are hidden (homes, /tmp, /run, mounts).
struct SandboxView {
  std::string writable;               ///< host directory, seen as `sandbox_directory`
  std::vector<std::string> readable;  ///< absolute paths, seen as they are
  std::vector<std::string> hidden;    ///< more directories to hide
  unsigned user = 0;                  ///< that it becomes, of root's runs; set by run_confined
};

/// Where a confined program runs; the rest of /tmp is its own, small, and lost.
inline constexpr const char* sandbox_directory = "/tmp/judged";

/// Throws std::runtime_error, saying what to do, when bubblewrap is missing or may not make namespaces.
void require_sandbox();

/// Never runs unconfined. At its return no process of the run is left. Throws std::runtime_error when it
/// cannot be started.
SandboxRun run_confined(const std::vector<std::string>& command, const SandboxView& view,
                        const SandboxLimits& limits);

/// Whether a path lies in a place that a confined program does not see by itself.
bool is_hidden(const std::string& path);

}  // namespace plumb::references
