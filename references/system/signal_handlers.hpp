// What acts on the signals that end a program, for a while.
#pragma once

#include <array>
#include <csignal>

namespace plumb::system {

/// The signals that a person or a terminal ends a program by.
inline constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP};

/// While it lives, a handler acts on the ending signals, but for those that are ignored, as under nohup; at
/// the end of its scope they act as before.
class SignalHandlers {
 public:
  explicit SignalHandlers(void (*handler)(int));
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

  /// Lets one of them act as before. May be called in the handler.
  void restore(int number) const;

 private:
  std::array<struct sigaction, ending_signals.size()> before_;
};

}  // namespace plumb::system
