#include "references/system/signal_handlers.hpp"

namespace plumb::system {

SignalHandlers::SignalHandlers(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    ::sigaction(ending_signals.at(i), nullptr, &before_.at(i));
    if (before_.at(i).sa_handler != SIG_IGN) ::sigaction(ending_signals.at(i), &action, nullptr);
  }
}

SignalHandlers::~SignalHandlers() {
  for (const int number : ending_signals) restore(number);
}

void SignalHandlers::restore(int number) const {
  for (std::size_t i = 0; i < before_.size(); ++i)
    if (ending_signals.at(i) == number) ::sigaction(number, &before_.at(i), nullptr);
}

}  // namespace plumb::system
