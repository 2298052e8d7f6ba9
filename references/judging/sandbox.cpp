#include "references/judging/sandbox.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "references/judging/process_tree.hpp"
#include "references/judging/sandbox_arguments.hpp"
#include "references/process.hpp"

namespace plumb::references {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kept_bytes = std::size_t{16} << 10;
/// because a fork bomb makes some thousand processes in a tenth of a second
constexpr int watch_milliseconds = 20;

void limit(__rlimit_resource resource, std::size_t amount) {
  rlimit now{};
  getrlimit(resource, &now);
  const rlim_t least = std::min<rlim_t>(amount, now.rlim_max);
  const rlimit both{least, least};
  setrlimit(resource, &both);
}

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, int output, const SandboxLimits& limits) {
  // Behind the watcher, in case that it is late; threads count, too. Others' runs of root are other users.
  const std::size_t users_processes = geteuid() == 0 ? 4 * limits.processes : 1024;
  static char* const no_environment[] = {nullptr};
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpriority(PRIO_PROCESS, 0, 10);  // so that a bomb does not hold up who watches it
  const int null = open("/dev/null", O_RDONLY);
  if (dup2(null, 0) < 0 || dup2(output, 1) < 0 || dup2(output, 2) < 0) _exit(127);
  close_range(3, ~0U, 0);
  limit(RLIMIT_FSIZE, limits.disk_bytes);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::size_t>(limits.cpu_seconds) + 1);
  limit(RLIMIT_NPROC, users_processes);
  for (const int number : {SIGXFSZ, SIGPIPE}) signal(number, SIG_DFL);
  execve(arguments[0], arguments, no_environment);
  _exit(127);
}

struct Started {
  pid_t child;
  int output;  ///< the end to read from
};

Started start(const std::vector<std::string>& command, const SandboxLimits& limits) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe: " + std::string(std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) become(arguments.data(), ends[1], limits);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw std::runtime_error("bwrap cannot be started: " + std::string(std::strerror(errno)));
  }
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return {child, ends[0]};
}

/// Kills the first process of the namespace: the kernel then ends all others before bwrap learns of it.
void kill_all(pid_t bwrap) {
  const std::vector<pid_t> inside = children_of(bwrap);
  if (inside.empty()) kill(bwrap, SIGKILL);
  for (const pid_t process : inside) kill(process, SIGKILL);
}

bool leaves_too_much(const std::string& directory, const SandboxLimits& limits) {
  std::size_t bytes = 0;
  std::size_t files = 0;
  std::error_code error;
  fs::recursive_directory_iterator at(directory, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    std::error_code gone;
    if (at->is_regular_file(gone) && !at->is_symlink(gone)) {
      const auto size = at->file_size(gone);
      if (!gone) bytes += size;
    }
    if (++files > limits.files || bytes >= limits.disk_bytes || at.depth() > 32) return true;
  }
  return false;
}

class Watch {
 public:
  Watch(const Started& started, const SandboxView& view, const SandboxLimits& limits)
      : started_(started), view_(view), limits_(limits) {}

  SandboxRun until_the_end() {
    bool is_killed = false;
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(started_.child, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
      pollfd waiting{started_.output, POLLIN, 0};
      poll(is_open_ ? &waiting : nullptr, is_open_ ? 1 : 0, watch_milliseconds);
      drain();
      if (is_killed || !is_due()) continue;
      run_.ending = judged();
      is_killed = run_.ending != Ending::finished;
      if (is_killed) kill_all(started_.child);
    }
    drain();
    close(started_.output);
    run_.wall_seconds = seconds();
    if (!is_killed) set_end(status);
    return run_;
  }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  /// Reading is not held up by looking, and looking not by reading.
  bool is_due() {
    if (Clock::now() < next_ && printed_ <= limits_.printed_bytes) return false;
    next_ = Clock::now() + std::chrono::milliseconds(watch_milliseconds);
    return true;
  }

  void drain() {
    char buffer[65536];
    for (int i = 0; is_open_ && i < 16; ++i) {
      const ssize_t size = read(started_.output, buffer, sizeof buffer);
      if (size == 0) is_open_ = false;
      if (size <= 0) return;
      const auto bytes = static_cast<std::size_t>(size);
      run_.printed.append(buffer, std::min(bytes, kept_bytes - run_.printed.size()));
      printed_ += bytes;
    }
  }

  Ending judged() const {
    if (printed_ > limits_.printed_bytes) return Ending::too_much_output;
    if (seconds() > limits_.wall_seconds) return Ending::timed_out;
    const TreeUsage usage = usage_below(started_.child);
    if (usage.processes > limits_.processes) return Ending::too_many_processes;
    if (usage.memory_bytes > limits_.memory_bytes) return Ending::too_much_memory;
    if (usage.cpu_seconds > limits_.cpu_seconds) return Ending::too_much_cpu;
    return leaves_too_much(view_.writable, limits_) ? Ending::too_much_output : Ending::finished;
  }

  /// bwrap tells a signal as a shell does, 128 more than its number.
  void set_end(int status) {
    run_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (run_.exit_code > 128 && run_.exit_code < 128 + 65) run_.signal = run_.exit_code - 128;
    if (run_.signal == SIGXCPU) run_.ending = Ending::too_much_cpu;
    if (run_.signal == SIGXFSZ || printed_ > limits_.printed_bytes ||
        leaves_too_much(view_.writable, limits_))
      run_.ending = Ending::too_much_output;
  }

  Started started_;
  const SandboxView& view_;
  const SandboxLimits& limits_;
  SandboxRun run_;
  std::size_t printed_ = 0;
  bool is_open_ = true;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

/// Root's processes are not counted, and root reads all: its runs become somebody who owns nothing else.
unsigned a_new_user() {
  static std::atomic<unsigned> next = 0;
  return 1'900'000'000U + static_cast<unsigned>(getpid()) % 100'000U * 1000U + next++ % 1000U;
}

std::string bubblewrap() {
  const std::string program = find_program("bwrap");
  if (!program.empty()) return program;
  throw std::runtime_error(
      "bwrap was not found: other people's programs are never run unconfined; apt-get install bubblewrap");
}

}  // namespace

SandboxRun run_confined(const std::vector<std::string>& command, const SandboxView& view,
                        const SandboxLimits& limits) {
  SandboxView own = view;
  if (geteuid() == 0) {
    own.user = a_new_user();
    if (chown(view.writable.c_str(), own.user, own.user) != 0)
      throw std::runtime_error(view.writable + ": cannot be given away: " + std::strerror(errno));
  }
  const Started started = start(sandbox_arguments(bubblewrap(), command, own), limits);
  return Watch(started, own, limits).until_the_end();
}

void require_sandbox() {
  const TemporaryDirectory directory;
  const SandboxRun run = run_confined({"/bin/true"}, {directory.path(), {}, {}}, {});
  if (run.ending == Ending::finished && run.exit_code == 0) return;
  throw std::runtime_error(
      "bwrap may not confine programs on this machine, and they are never run unconfined: " + run.printed +
      "Namespaces must be permitted: sysctl kernel.unprivileged_userns_clone=1 and, on Ubuntu, "
      "kernel.apparmor_restrict_unprivileged_userns=0; in Docker: --security-opt seccomp=unconfined "
      "--security-opt systempaths=unconfined; pictures alone can be judged with --images");
}

}  // namespace plumb::references
