#include "tracer/image/decoder/keeper.hpp"

#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace plumb::decoder {

Keeper::~Keeper() {
  for (const Kept& kept : all_) ::kill(kept.process, SIGKILL);
}

void Keeper::run(const DecodeFiles& files, const std::function<void()>& work) {
  const Descriptor source(files.source), pixels(files.pixels), message(files.message);
  auto status = std::make_unique<Descriptor>(files.status);
  const pid_t process = ::fork();
  if (process == 0) {
    status.reset();
    all_.clear();  // so that it writes to no pipe that is not its own
    work();
    ::_exit(1);
  }
  if (process < 0) return;  // the closed pipe tells that
  const long handle = ::syscall(SYS_pidfd_open, process, 0);
  all_.push_back({process, std::make_unique<Descriptor>(static_cast<int>(handle)), std::move(status)});
}

bool Keeper::has_ended(const Kept& kept) {
  int status = 0;
  if (::waitpid(kept.process, &status, WNOHANG) != kept.process) return false;
  static_cast<void>(!::write(kept.status->number(), &status, sizeof status));  // nobody reads it who gave up
  return true;
}

void Keeper::keep_until_readable(int socket) {
  for (bool is_readable = false; !is_readable;) {
    std::vector<pollfd> waited{{socket, POLLIN, 0}};
    for (const Kept& kept : all_) {
      waited.push_back({kept.handle->number(), POLLIN, 0});
      waited.push_back({kept.is_killed ? -1 : kept.status->number(), 0, 0});
    }
    if (::poll(waited.data(), waited.size(), -1) < 0) continue;
    is_readable = waited[0].revents != 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (waited[2 * i + 2].revents == 0) continue;
      ::kill(all_[i].process, SIGKILL);
      all_[i].is_killed = true;
    }
    std::erase_if(all_, has_ended);
  }
}

}  // namespace plumb::decoder
