// Files and directories that must not be left behind, whatever ends the program.
#pragma once

#include <string>

namespace plumb {

/// From here on SIGBUS, which is what looking at a mapped file becomes when somebody cuts it short, removes
/// what is to be removed, says so on standard error and ends the program with exit code 2. It replaces a
/// handler that is there already: AddressSanitizer has one.
void expect_cut_files();

/// While it lives, SIGINT, SIGTERM and SIGHUP remove `path`, with all it holds, before they end the program.
/// They end it as they would have without: by that signal. The path must be absolute or stay valid in the
/// working directory, and its last part must begin with "plumb-" or ".plumb-"; of more than 64 at once some
/// stay.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  void* slot_ = nullptr;
};

}  // namespace plumb
