// Runs other people's programs in a directory, with limits on time, memory and output.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tracer/system/cleanup.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::system {

struct ProcessLimits {
  double seconds = 600;  ///< of wall time; then the process group is killed
  std::size_t memory_bytes = std::size_t{8} << 30;
  std::size_t file_bytes = std::size_t{8} << 30;  ///< of any one file that it writes
};

struct ProcessResult {
  int exit_code = -1;  ///< valid when it was neither killed by a signal nor late
  int signal = 0;
  bool timed_out = false;
  double cpu_seconds = 0;  ///< user and system, children included
  std::string output;      ///< standard output and error, at most 1 MiB
};

/// A directory that is removed, with all it holds, at the end of its scope or by a signal. What a killed run
/// leaves, a later one removes.
class TemporaryDirectory {
 public:
  TemporaryDirectory();  ///< Throws std::runtime_error.
  /// Makes a hidden one in `parent`: what is to be renamed must lie on the file system of its target. Throws
  /// std::runtime_error.
  explicit TemporaryDirectory(const std::string& parent);
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::string& path() const { return path_; }

 private:
  void make(const std::string& parent, const std::string& prefix);

  std::string path_;
  std::optional<RemovedOnSignal> on_signal_;
  std::optional<Descriptor> claim_;
};

/// Runs a program (an absolute path) without a shell and without standard input, in `directory`, which is
/// also its HOME. Its environment is `variables`, each NAME=value, and ours for other names. Throws
/// std::runtime_error when it cannot be started.
ProcessResult run_process(const std::vector<std::string>& command, const std::string& directory,
                          const ProcessLimits& limits, const std::vector<std::string>& variables = {});

/// Returns the absolute path of a program on PATH, or an empty text.
std::string find_program(const std::string& name);

}  // namespace plumb::system
