// Files and directories that must not be left behind, whatever ends the program.
#pragma once

#include <string>

namespace plumb {

/// While it lives, SIGINT, SIGTERM and SIGHUP remove `path`, with all it holds, before they end the program.
/// They end it as they would have without: by that signal.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(std::string path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  std::string path_;
};

}  // namespace plumb
