#include "references/submissions/sandbox/confined_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "references/submissions/sandbox/sandbox_arguments.hpp"
#include "references/submissions/sandbox/system_call_filter.hpp"
#include "references/system/process.hpp"
#include "tracer/system/files.hpp"

namespace plumb::submissions {
namespace {

namespace fs = std::filesystem;

/// The time limit, because a machine that is busy with other runs may take a second.
constexpr auto longest_setup = std::chrono::seconds(60);
constexpr auto longest_end = std::chrono::seconds(60);

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("the sandbox failed: " + what + ": " + std::strerror(errno));
}

struct Pipe {
  std::unique_ptr<Descriptor> from, to;
};

Pipe a_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("no pipe");
  return {std::make_unique<Descriptor>(ends[0]), std::make_unique<Descriptor>(ends[1])};
}

std::unique_ptr<Descriptor> filter_file() {
  const std::vector<sock_filter> filter = system_call_filter(control_groups().keeps_memory);
  auto file = std::make_unique<Descriptor>(memfd_create("plumb-filter", MFD_CLOEXEC));
  const std::size_t bytes = filter.size() * sizeof(sock_filter);
  if (write(file->number(), filter.data(), bytes) != static_cast<ssize_t>(bytes) ||
      lseek(file->number(), 0, SEEK_SET) != 0)
    fail("the filter of system calls cannot be written");
  return file;
}

void limit(__rlimit_resource resource, std::size_t amount) {
  rlimit now{};
  getrlimit(resource, &now);
  const rlim_t least = std::min<rlim_t>(amount, now.rlim_max);
  const rlimit both{least, least};
  setrlimit(resource, &both);
}

struct Inherited {
  int output, status, release, filter, group;
};

/// Gives descriptors 0 to 5 the meaning that `bwrap` is told, and closes all others.
bool set_descriptors(const Inherited& given) {
  const int wanted[] = {
      open("/dev/null", O_RDONLY), given.output, given.output, given.status, given.release, given.filter};
  int moved[6];
  for (int i = 0; i < 6; ++i) moved[i] = fcntl(wanted[i], F_DUPFD, 16);
  for (int i = 0; i < 6; ++i)
    if (moved[i] < 0 || dup2(moved[i], i) != i) return false;
  return close_range(6, ~0U, 0) == 0;
}

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, const Inherited& given, const SandboxLimits& limits) {
  static char* const no_environment[] = {nullptr};
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (given.group >= 0 && write(given.group, "0", 1) != 1) _exit(126);
  setpriority(PRIO_PROCESS, 0, 10);  // so that a bomb does not hold up the process that watches it
  if (!set_descriptors(given)) _exit(126);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::size_t>(limits.cpu_seconds) + 1);
  // The program has its own limit; with this one the kernel would count all runs of our user together.
  limit(RLIMIT_NPROC, RLIM_INFINITY);
  for (const int number : {SIGXFSZ, SIGPIPE}) signal(number, SIG_DFL);
  execve(arguments[0], arguments, no_environment);
  _exit(126);
}

/// Returns a user who owns nothing else. Root's processes are not counted and read all, so its runs become
/// this user.
unsigned a_new_user() {
  static std::atomic<unsigned> next = 0;
  return 1'900'000'000U + static_cast<unsigned>(getpid()) % 100'000U * 1000U + next++ % 1000U;
}

/// Returns the whole number behind the key in bubblewrap's JSON; -1 when it is not there.
int number_behind(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\"" + key + "\":");
  return at == std::string::npos
             ? -1
             : static_cast<int>(std::strtol(text.c_str() + at + key.size() + 3, nullptr, 10));
}

std::string all_of(int file) {
  std::string text(4096, '\0');
  const ssize_t size = read(file, text.data(), text.size());
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

void copy_into(int directory, const fs::path& file) {
  const Descriptor copy(
      openat(directory, file.filename().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  const std::string bytes = read_file(file.string());
  if (copy.number() < 0 ||
      write(copy.number(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    fail(file.string() + " cannot be copied for the program (is --disk large enough?)");
  fchmod(copy.number(), 0644);
}

void copy_all(int directory, const std::string& given) {
  if (given.empty()) return;
  for (const auto& entry : fs::directory_iterator(given))
    if (entry.is_regular_file()) copy_into(directory, entry.path());
}

}  // namespace

std::string found_bubblewrap() {
  const std::string program = system::find_program("bwrap");
  if (!program.empty()) return program;
  throw std::runtime_error(
      "bwrap was not found: other people's programs are never run unconfined; apt-get install bubblewrap");
}

ConfinedProcess::ConfinedProcess(const std::vector<std::string>& command, const SandboxView& view,
                                 const SandboxLimits& limits, const ControlGroup& group) {
  const unsigned user = geteuid() == 0 ? a_new_user() : 0;
  const std::vector<std::string> words = sandbox_arguments(found_bubblewrap(), command, view, limits, user);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Pipe output = a_pipe(), status = a_pipe(), release = a_pipe();
  const auto filter = filter_file();
  const Inherited given{output.to->number(), status.to->number(), release.from->number(), filter->number(),
                        group.entrance()};
  bubblewrap_ = fork();
  if (bubblewrap_ == 0) become(arguments.data(), given, limits);
  if (bubblewrap_ < 0) fail("bwrap cannot be started");
  output_ = std::move(output.from);
  status_ = std::move(status.from);
  release_ = std::move(release.to);
  for (const auto* const read_end : {&output_, &status_}) fcntl((*read_end)->number(), F_SETFL, O_NONBLOCK);
  try {
    output.to.reset(), status.to.reset(), release.from.reset();
    wait_for_setup();
    copy_all(directory_->number(), view.given);
  } catch (...) {
    end();
    throw;
  }
}

ConfinedProcess::~ConfinedProcess() { end(); }

void ConfinedProcess::end() {
  if (is_over_) return;
  kill_all();
  while (!has_ended()) usleep(1000);
}

void ConfinedProcess::wait_for_setup() {
  const auto latest = std::chrono::steady_clock::now() + longest_setup;
  while (!opened_directory()) {
    if (has_ended()) throw std::runtime_error("the sandbox failed: " + all_of(output()));
    if (std::chrono::steady_clock::now() > latest)
      throw std::runtime_error("the sandbox failed: it was not set up within a minute: " + all_of(output()));
    usleep(500);
  }
}

bool ConfinedProcess::opened_directory() {
  read_status();
  if (first_ <= 0 && status_text_.find('}') != std::string::npos)
    first_ = number_behind(status_text_, "child-pid");
  if (first_ <= 0) return false;
  const std::string root = "/proc/" + std::to_string(first_) + "/root";
  if (access((root + sign_of_setup).c_str(), F_OK) != 0) return false;
  first_handle_ = std::make_unique<Descriptor>(static_cast<int>(syscall(SYS_pidfd_open, first_, 0)));
  const auto opened = [&](const std::string& path) {
    return open((root + path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  };
  directory_ = std::make_shared<const Descriptor>(opened(sandbox_directory));
  shared_memory_ = std::make_unique<Descriptor>(opened("/dev/shm"));
  if (first_handle_->number() < 0 || directory_->number() < 0 || shared_memory_->number() < 0)
    fail("its directory cannot be opened");
  return true;
}

void ConfinedProcess::read_status() { status_text_ += all_of(status_->number()); }

void ConfinedProcess::begin() {
  if (write(release_->number(), "x", 1) != 1) fail("the program cannot be released");
  release_.reset();
}

bool ConfinedProcess::has_ended() {
  int status = 0;
  const pid_t ended = is_over_ ? bubblewrap_ : waitpid(bubblewrap_, &status, WNOHANG);
  is_over_ = ended == bubblewrap_ || (ended < 0 && errno != EINTR);
  return is_over_;
}

void ConfinedProcess::kill_all() const {
  if (first_handle_) syscall(SYS_pidfd_send_signal, first_handle_->number(), SIGKILL, nullptr, 0);
  if (!first_handle_) kill(bubblewrap_, SIGKILL);
}

void ConfinedProcess::wait_for_the_last() const {
  pollfd ended{first_handle_->number(), POLLIN, 0};
  const int limit = static_cast<int>(std::chrono::milliseconds(longest_end).count());
  if (poll(&ended, 1, limit) != 1) fail("its processes do not end");
}

int ConfinedProcess::exit_code() {
  read_status();
  return number_behind(status_text_, "exit-code");
}

ConfinedProcess::Disk ConfinedProcess::disk() const {
  struct statvfs files {};
  struct statvfs shared {};
  if (fstatvfs(directory_->number(), &files) != 0 || fstatvfs(shared_memory_->number(), &shared) != 0)
    fail("its disk cannot be looked at");
  const auto bytes_in = [](const struct statvfs& disk) {
    return (disk.f_blocks - disk.f_bfree) * disk.f_frsize;
  };
  const auto files_in = [](const struct statvfs& disk) { return disk.f_files - disk.f_ffree; };
  const std::size_t least_free = std::min(files.f_bfree, shared.f_bfree) * files.f_frsize;
  return {bytes_in(files) + bytes_in(shared), least_free, files_in(files) + files_in(shared)};
}

}  // namespace plumb::submissions
