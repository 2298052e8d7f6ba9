#include "references/cli/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace plumb::cli {

Progress::Progress(std::string what)
    : what_(std::move(what)), is_terminal_(isatty(STDERR_FILENO) != 0), begin_(Clock::now()), last_(begin_) {}

Progress::~Progress() { clear(); }

void Progress::show(double fraction) {
  using std::chrono::milliseconds;
  if (!is_terminal_) return;
  const auto now = Clock::now();
  if (now - begin_ < milliseconds(1000) || now - last_ < milliseconds(100)) return;
  last_ = now;
  is_drawn_ = true;
  std::fprintf(stderr, "\r%s %3.0f %%\x1b[K", what_.c_str(), 100 * fraction);
}

void Progress::clear() {
  if (!is_drawn_) return;
  std::fprintf(stderr, "\r\x1b[K");
  is_drawn_ = false;
}

}  // namespace plumb::cli
