#include "tracer/image/decoder_service.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "tracer/image/confined_decoder.hpp"
#include "tracer/system/installation.hpp"

extern char** environ;

namespace plumb {
namespace {

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), "a picture cannot be decoded: " + what);
}

/// Starts the decoder, with the socket as its standard input. It gets nothing else of ours, so that nobody
/// waits for it to close that.
pid_t spawn(const std::string& program, int socket) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, 0);
  for (const int output : {1, 2})
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  std::array<char*, 3> arguments{const_cast<char*>(program.c_str()), const_cast<char*>(serve_argument),
                                 nullptr};
  pid_t process = 0;
  const int error = ::posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail(error, program + " cannot be run");
  return process;
}

}  // namespace

DecoderService& DecoderService::shared() {
  static DecoderService service;
  return service;
}

DecoderService::~DecoderService() {
  socket_.reset();
  wait();
}

void DecoderService::wait() {
  while (process_ > 0 && ::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

DecoderService::Socket DecoderService::running(const Socket& lost) {
  const std::lock_guard lock(mutex_);
  if (socket_ && socket_ != lost) return socket_;
  wait();
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(errno, "socketpair");
  const Descriptor theirs(ends[1]);
  socket_ = std::make_shared<const Descriptor>(ends[0]);
  const std::string program = module_path(decoder_name);
  try {
    process_ = spawn(program, theirs.number());
  } catch (...) {
    socket_.reset();
    throw;
  }
  return socket_;
}

void DecoderService::hand_over(const DecodeRequest& request, const DecodeFiles& files) {
  const std::string text = text_of(request);
  if (text.size() > longest_request) fail(E2BIG, "the name of its part is too long");
  Socket socket = running(nullptr);
  if (send_files(socket->number(), text, files)) return;
  socket = running(socket);
  if (!send_files(socket->number(), text, files)) fail(errno, "its decoder is gone");
}

}  // namespace plumb
