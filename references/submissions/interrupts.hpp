// Handles Ctrl-C while a class is judged: what is done is kept and written, what runs is ended.
#pragma once

namespace plumb::submissions {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is only remembered. A second one ends the program as
/// it would have before. Only one may live at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  static bool came();
};

/// Kills all processes that this one has started, and all that those have started.
void kill_children();

}  // namespace plumb::submissions
