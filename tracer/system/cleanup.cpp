#include "tracer/system/cleanup.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <string_view>

namespace plumb {
namespace {

/// A place for one path. Its size is fixed, because a signal handler may not allocate.
struct Slot {
  std::atomic<bool> is_taken{false};
  std::atomic<bool> is_ready{false};
  std::array<char, 4000> path{};
};
std::array<Slot, 64> slots;  // one for each file and directory that is open at once; others are not removed

/// True for names that only this program gives. Nothing else is ever removed, so nothing of the user's.
bool is_ours(const char* path) {
  const char* const slash = std::strrchr(path, '/');
  const char* const name = slash == nullptr ? path : slash + 1;
  return std::strncmp(name, "plumb-", 6) == 0 || std::strncmp(name, ".plumb-", 7) == 0;
}

/// In the child of the handler's fork: only calls that are safe there.
[[noreturn]] void become_rm() {
  std::array<char*, slots.size() + 4> arguments{};
  static char rm[] = "/bin/rm";
  static char options[] = "-rf";
  static char end_of_options[] = "--";
  arguments[0] = rm;
  arguments[1] = options;
  arguments[2] = end_of_options;
  std::size_t count = 3;
  for (Slot& slot : slots) {
    if (slot.is_ready && is_ours(slot.path.data())) arguments[count++] = slot.path.data();
  }
  ::execv(rm, arguments.data());
  ::_exit(1);
}

void remove_all() {
  const pid_t child = ::_Fork();  // unlike fork() safe in a handler
  if (child == 0) become_rm();
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
}

/// It is not known here which file it was: what is at the address may be unmapped at the same time.
[[noreturn]] void on_cut_file(int) {
  remove_all();
  constexpr std::string_view said =
      "plumb: an image file was cut short by somebody else while it was read, expected it to stay as it is; "
      "run again when it is whole\n";
  static_cast<void>(!::write(STDERR_FILENO, said.data(), said.size()));
  ::_exit(2);
}

void on_signal(int number) {
  remove_all();
  ::signal(number, SIG_DFL);
  ::raise(number);  // acts when the handler returns
}

void install(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigaction(number, &action, nullptr);
}

void install_handlers() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    if (::sigaction(number, nullptr, &old) == 0 && old.sa_handler != SIG_DFL) continue;  // as under nohup
    install(number, &on_signal);
  }
}

Slot* slot_for(const std::string& path) {
  const auto free =
      std::find_if(slots.begin(), slots.end(), [](Slot& s) { return !s.is_taken.exchange(true); });
  if (free == slots.end()) return nullptr;
  if (path.size() >= free->path.size()) {
    free->is_taken = false;
    return nullptr;
  }
  std::copy_n(path.c_str(), path.size() + 1, free->path.data());
  free->is_ready = true;
  return &*free;
}

}  // namespace

void expect_cut_files() { install(SIGBUS, &on_cut_file); }

RemovedOnSignal::RemovedOnSignal(const std::string& path) {
  static std::once_flag installed;
  std::call_once(installed, install_handlers);
  slot_ = slot_for(path);
}

RemovedOnSignal::~RemovedOnSignal() {
  if (slot_ == nullptr) return;
  auto* const slot = static_cast<Slot*>(slot_);
  slot->is_ready = false;
  slot->is_taken = false;
}

}  // namespace plumb
