#include "references/submissions/interrupts.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <string_view>

#include "references/submissions/sandbox/process_tree.hpp"
#include "references/system/process.hpp"

namespace plumb::references {
namespace {

constexpr std::array numbers{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, numbers.size()> actions_before;
std::atomic<bool> has_come{false};

void say_it_stops() {
  constexpr std::string_view said = "\nstopping: what is done is written; once more ends it at once\n";
  static_cast<void>(!::write(STDERR_FILENO, said.data(), said.size()));
}

void on_signal(int number) {
  if (!has_come.exchange(true)) return say_it_stops();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers.at(i) == number) ::sigaction(number, &actions_before.at(i), nullptr);
  }
  ::raise(number);  // acts when this handler returns
}

}  // namespace

Interrupts::Interrupts() {
  const TemporaryDirectory installs_what_cleans_up;  // which a second signal shall find
  has_come = false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = &on_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(numbers.at(i), nullptr, &actions_before.at(i));
    const bool is_ignored = actions_before.at(i).sa_handler == SIG_IGN;  // as under nohup
    if (!is_ignored) ::sigaction(numbers.at(i), &action, nullptr);
  }
}

Interrupts::~Interrupts() {
  for (std::size_t i = 0; i < numbers.size(); ++i) ::sigaction(numbers.at(i), &actions_before.at(i), nullptr);
}

bool Interrupts::came() { return has_come; }

void kill_children() {
  for (const TreeMember& member : usage_below(::getpid()).members) ::kill(member.id, SIGKILL);
}

}  // namespace plumb::references
