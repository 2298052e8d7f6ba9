#include "references/system/held_signals.hpp"

#include <array>
#include <atomic>
#include <csignal>

namespace plumb::references {
namespace {

constexpr std::array numbers{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, numbers.size()> before;
std::array<std::atomic<bool>, numbers.size()> has_come;

void remember(int number) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers.at(i) == number) has_come.at(i) = true;
}

}  // namespace

HeldSignals::HeldSignals() {
  struct sigaction action {};
  action.sa_handler = &remember;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    has_come.at(i) = false;
    ::sigaction(numbers.at(i), nullptr, &before.at(i));
    const bool is_ignored = before.at(i).sa_handler == SIG_IGN;  // as under nohup
    if (!is_ignored) ::sigaction(numbers.at(i), &action, nullptr);
  }
}

HeldSignals::~HeldSignals() {
  for (std::size_t i = 0; i < numbers.size(); ++i) ::sigaction(numbers.at(i), &before.at(i), nullptr);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (has_come.at(i)) ::raise(numbers.at(i));
}

}  // namespace plumb::references
