#include "references/submissions/interrupts.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <optional>
#include <string_view>

#include "references/submissions/sandbox/process_tree.hpp"
#include "references/system/process.hpp"
#include "references/system/signal_handlers.hpp"

namespace plumb::submissions {
namespace {

std::optional<system::SignalHandlers> handlers;
std::atomic<bool> has_come{false};

void say_it_stops() {
  constexpr std::string_view said = "\nstopping: what is done is written; once more ends it at once\n";
  static_cast<void>(!::write(STDERR_FILENO, said.data(), said.size()));
}

void on_signal(int number) {
  if (!has_come.exchange(true)) return say_it_stops();
  if (handlers) handlers->restore(number);
  ::raise(number);  // acts when this handler returns
}

}  // namespace

Interrupts::Interrupts() {
  const system::TemporaryDirectory installs_what_cleans_up;  // which a second signal shall find
  has_come = false;
  handlers.emplace(&on_signal);
}

Interrupts::~Interrupts() { handlers.reset(); }

bool Interrupts::came() { return has_come; }

void kill_children() {
  for (const TreeMember& member : usage_below(::getpid()).members) ::kill(member.id, SIGKILL);
}

}  // namespace plumb::submissions
