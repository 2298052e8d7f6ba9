#include "tracer/image/cleanup.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

namespace plumb {
namespace {

/// The handler may do next to nothing, so it wakes a thread through a pipe, and that does the work.
class Remover {
 public:
  static Remover& instance() {
    static auto* const remover = new Remover;  // never destroyed: its thread outlives main
    return *remover;
  }

  void add(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_.insert(path);
  }
  void forget(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_.erase(path);
  }

 private:
  Remover() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;  // signals then end the program at once, as ever
    signalled_ = ends[0];
    to_thread_ = ends[1];
    std::thread([this] { wait(); }).detach();
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction old {};
      if (::sigaction(number, nullptr, &old) == 0 && old.sa_handler == SIG_IGN) continue;  // as under nohup
      struct sigaction action {};
      action.sa_handler = &Remover::on_signal;
      action.sa_flags = SA_RESTART;
      ::sigaction(number, &action, nullptr);
    }
  }

  static void on_signal(int number) {
    const int error = errno;
    const auto byte = static_cast<unsigned char>(number);
    [[maybe_unused]] const ssize_t written = ::write(to_thread_, &byte, 1);
    errno = error;
  }

  void wait() {
    unsigned char byte = 0;
    while (::read(signalled_, &byte, 1) != 1) {
    }
    // Never unlocked: nothing is to be made any more that would be left behind.
    mutex_.lock();
    std::error_code ignored;
    for (const std::string& path : paths_) std::filesystem::remove_all(path, ignored);
    std::signal(byte, SIG_DFL);
    ::kill(::getpid(), byte);
  }

  std::mutex mutex_;
  std::set<std::string> paths_;
  int signalled_ = -1;
  static inline int to_thread_ = -1;
};

}  // namespace

RemovedOnSignal::RemovedOnSignal(std::string path) : path_(std::move(path)) {
  Remover::instance().add(path_);
}
RemovedOnSignal::~RemovedOnSignal() { Remover::instance().forget(path_); }

}  // namespace plumb
