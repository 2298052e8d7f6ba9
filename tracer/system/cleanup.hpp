// Removes temporary files and directories when a signal ends the program.
#pragma once

#include <string>

namespace plumb {

/// From this call on, SIGBUS removes what RemovedOnSignal has, reports a cut file on standard error and ends
/// the program with exit code 2. Reading a mapped file raises SIGBUS after somebody has cut it short. The
/// call replaces an earlier handler: AddressSanitizer has one.
void expect_cut_files();

/// While it lives, SIGINT, SIGTERM and SIGHUP remove `path`, with all it holds, and then end the program by
/// that signal. The path must be absolute or stay valid in the working directory. Its last part must begin
/// with "plumb-" or ".plumb-". At most 64 paths are removed; what is above that stays.
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
