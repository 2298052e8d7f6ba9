#include "references/submissions/sandbox/sandbox.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <stdexcept>

#include "references/submissions/sandbox/confined_process.hpp"
#include "references/submissions/sandbox/control_group.hpp"
#include "references/submissions/sandbox/process_tree.hpp"

namespace plumb::submissions {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kept_bytes = std::size_t{16} << 10;
/// The pause between looks, because a fork bomb makes some thousand processes in a tenth of a second.
constexpr int watch_milliseconds = 20;

/// Share of the time that passed: a program that computes without a pause and got less CPU was kept from it.
constexpr double most_of_starved = 0.8;
/// Share of the CPU time allowed, because the last look was some time before the end.
constexpr double near_cpu_limit = 0.8;

class Watch {
 public:
  Watch(ConfinedProcess& process, const ControlGroup& group, const SandboxLimits& limits)
      : process_(process), group_(group), limits_(limits), files_before_(process.disk().files) {}

  SandboxRun until_the_end() {
    bool is_killed = false;
    while (!process_.has_ended()) {
      pollfd waiting{process_.output(), POLLIN, 0};
      poll(is_open_ ? &waiting : nullptr, is_open_ ? 1 : 0, watch_milliseconds);
      drain();
      if (is_killed || !is_due()) continue;
      run_.ending = ending_by_now();
      is_killed = run_.ending != Ending::finished;
      if (is_killed) process_.kill_all();
    }
    process_.wait_for_the_last();
    drain();
    run_.wall_seconds = seconds();
    run_.left = process_.directory();
    fchmod(run_.left->number(), 0700);  // the program may have closed its directory, even for us
    if (!is_killed) set_end();
    return run_;
  }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  /// Neither reading delays looking, nor looking reading.
  bool is_due() {
    if (Clock::now() < next_ && printed_ <= limits_.disk_bytes) return false;
    next_ = Clock::now() + std::chrono::milliseconds(watch_milliseconds);
    return true;
  }

  void drain() {
    char buffer[65536];
    for (int i = 0; is_open_ && i < 16; ++i) {
      const ssize_t size = read(process_.output(), buffer, sizeof buffer);
      if (size == 0) is_open_ = false;
      if (size <= 0) return;
      const auto bytes = static_cast<std::size_t>(size);
      run_.printed.append(buffer, std::min(bytes, kept_bytes - run_.printed.size()));
      printed_ += bytes;
    }
  }

  Ending ending_by_now() {
    if (printed_ > limits_.disk_bytes || is_disk_full()) return Ending::too_much_output;
    const TreeUsage usage = usage_below(process_.bubblewrap());
    // This comes before the time, which may be over only because so many processes are looked at.
    if (usage.processes > limits_.processes || usage.threads > most_tasks(limits_))
      return Ending::too_many_processes;
    cpu_seconds_ = group_.cpu_seconds().value_or(clock_.after(usage));
    if (seconds() > limits_.wall_seconds) {
      run_.was_starved = cpu_seconds_ < most_of_starved * seconds() && is_any_runnable(usage.members);
      return Ending::timed_out;
    }
    if (takes_too_much_memory(usage)) return Ending::too_much_memory;
    return cpu_seconds_ > limits_.cpu_seconds ? Ending::too_much_cpu : Ending::finished;
  }

  bool is_disk_full() const {
    const ConfinedProcess::Disk disk = process_.disk();
    return disk.free_bytes == 0 || disk.files > files_before_ + limits_.files;
  }

  /// False where the kernel keeps the limit.
  bool takes_too_much_memory(const TreeUsage& usage) const {
    if (control_groups().keeps_memory) return false;
    const std::size_t unseen = unseen_memory(usage.members) + process_.disk().bytes;
    if (usage.memory_bytes + unseen <= limits_.memory_bytes) return false;
    return private_memory(usage.members) + unseen > limits_.memory_bytes;
  }

  void set_end() {
    run_.exit_code = process_.exit_code();
    if (group_.ran_out_of_memory())
      run_.ending = Ending::too_much_memory;
    else if (run_.exit_code < 0)
      throw std::runtime_error("the sandbox failed: " + run_.printed);
    if (run_.exit_code > 128 && run_.exit_code < 128 + 65) run_.signal = run_.exit_code - 128;
    if (run_.signal == SIGXCPU && is_near_cpu_limit()) run_.ending = Ending::too_much_cpu;
    if (group_.ran_out_of_tasks()) run_.ending = Ending::too_many_processes;
    if ((run_.signal == SIGXFSZ && is_file_size_limited()) || printed_ > limits_.disk_bytes || is_disk_full())
      run_.ending = Ending::too_much_output;
    set_not_executed();
  }

  /// True near the limit. Far from it the program ended by itself, with the exit code that stands for the
  /// signal.
  bool is_near_cpu_limit() const {
    return group_.cpu_seconds().value_or(cpu_seconds_) > near_cpu_limit * limits_.cpu_seconds;
  }

  /// A limit that plumb was started with holds for the program, too.
  static bool is_file_size_limited() {
    rlimit now{};
    return getrlimit(RLIMIT_FSIZE, &now) == 0 && now.rlim_cur != RLIM_INFINITY;
  }

  /// setpriv(1) ends like this, naming the reason, when the kernel does not execute the program.
  void set_not_executed() {
    if (run_.exit_code != 126 && run_.exit_code != 127) return;
    if (!run_.printed.starts_with("setpriv: failed to execute ")) return;
    const std::string line = run_.printed.substr(0, run_.printed.find('\n'));
    run_.not_executed = line.substr(line.rfind(": ") + 2);
  }

  ConfinedProcess& process_;
  const ControlGroup& group_;
  const SandboxLimits& limits_;
  std::size_t files_before_;
  TreeClock clock_;
  SandboxRun run_;
  std::size_t printed_ = 0;
  double cpu_seconds_ = 0;  ///< when it was looked at last
  bool is_open_ = true;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

/// What went wrong when nothing but /bin/true is run; empty when it ran.
std::string trouble_with(const SandboxView& view) {
  try {
    const SandboxRun run = run_confined({"/bin/true"}, view, {});
    if (run.ending == Ending::finished && run.exit_code == 0) return {};
    return "/bin/true does not run in it: " + run.printed;
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace

std::string SandboxRun::directory() const { return "/proc/self/fd/" + std::to_string(left->number()); }

SandboxRun run_confined(const std::vector<std::string>& command, const SandboxView& view,
                        const SandboxLimits& limits) {
  const ControlGroup group(limits);
  ConfinedProcess process(command, view, limits, group);
  Watch watch(process, group, limits);
  process.begin();
  return watch.until_the_end();
}

void require_sandbox(const SandboxView& view, const std::string& program) {
  found_bubblewrap();
  const std::string trouble = trouble_with(view);
  if (!trouble.empty() && !trouble_with({}).empty()) {
    throw std::runtime_error(
        "bwrap may not confine programs on this machine, and they are never run unconfined: " + trouble +
        "; namespaces must be permitted: sysctl kernel.unprivileged_userns_clone=1 and, on Ubuntu, "
        "kernel.apparmor_restrict_unprivileged_userns=0; in Docker: --security-opt seccomp=unconfined "
        "--security-opt systempaths=unconfined; pictures alone can be judged with --images");
  }
  if (!trouble.empty()) throw std::runtime_error(trouble);
  if (program.empty() || run_confined({"/usr/bin/test", "-x", program}, view, {}).exit_code == 0) return;
  throw std::runtime_error(program +
                           ": the sandbox sees no program there that it may execute; it shows the "
                           "system's directories, what --readable names and where the program lies" +
                           (geteuid() == 0 ? "; of root's files what others may read (chmod -R go+rX)" : ""));
}

std::string limits_not_enforced() {
  if (control_groups().keeps_memory && control_groups().keeps_tasks) return {};
  std::string text =
      "the kernel does not keep the limits of memory and processes (no group of cgroup v2 with the "
      "controllers "
      "memory and pids can be made here): they are looked after every 20 ms; memory that is shared and no "
      "longer "
      "mapped and what the kernel holds for a program is not counted; memfd_create and System V memory are "
      "refused";
  if (geteuid() != 0) text += "; systemd-run --user --scope -p Delegate=yes plumb ... makes such a group";
  if (control_groups().parent.empty())
    text += "; CPU time of children that nobody waits for is counted as far as it is seen";
  return text;
}

}  // namespace plumb::submissions
