// Runs the built program as a user would, and makes files for it.
#pragma once

#include <string>
#include <vector>

#include "references/system/process.hpp"
#include "tracer/system/files.hpp"

namespace plumb::tests {

/// What LeakSanitizer is told in a run: leaks of libraries that are not ours.
std::string leak_options();

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
  double cpu_seconds;
};

/// Runs `plumb ARGUMENTS...` in the given directory, without a shell; its cache is in that directory, too.
/// `environment` adds NAME=value. A crash or a signal gives exit code 128 + its number; a run of more than
/// 120 s is killed.
Outcome run_plumb(const std::vector<std::string>& arguments, const std::string& directory,
                  const std::vector<std::string>& environment = {});

/// A temporary directory with files.
class Workplace {
 public:
  /// Writes a file and returns its absolute path.
  std::string file(const std::string& name, const std::string& text) const;
  std::string path(const std::string& name) const { return directory_.path() + "/" + name; }
  const std::string& directory() const { return directory_.path(); }

 private:
  system::TemporaryDirectory directory_;
};

/// Absolute path of a file of the repository.
std::string source_path(const std::string& relative);

}  // namespace plumb::tests
