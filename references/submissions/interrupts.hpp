// Ctrl-C while a class is judged: what is done is kept and written, what runs is ended.
#pragma once

namespace plumb::references {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is remembered and no more; a second one ends the
/// program as it would have without. One at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  static bool came();
};

/// Kills all that this process has started, and what that has started.
void kill_children();

}  // namespace plumb::references
