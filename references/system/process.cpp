#include "references/system/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "tracer/system/leftovers.hpp"

namespace plumb::system {
namespace {

constexpr std::size_t longest_output = std::size_t{1} << 20;
constexpr const char* output_name = "output.txt";

std::vector<char*> pointers(const std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (const std::string& s : strings) result.push_back(const_cast<char*>(s.c_str()));  // execve's signature
  result.push_back(nullptr);
  return result;
}

void limit(int resource, std::size_t amount) {
  const rlimit both{amount, amount};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* arguments, char* const* environment, const char* directory, int output,
                         const ProcessLimits& limits) {
  constexpr int cannot_run = 127;
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int null = open("/dev/null", O_RDONLY);
  if (chdir(directory) != 0 || dup2(null, 0) < 0 || dup2(output, 1) < 0 || dup2(output, 2) < 0)
    _exit(cannot_run);
  close_range(3, ~0U, 0);
  limit(RLIMIT_AS, limits.memory_bytes);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  limit(RLIMIT_CORE, 0);
  signal(SIGXFSZ, SIG_DFL);
  execve(arguments[0], arguments, environment);
  _exit(cannot_run);
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// Waits for the end, or kills the group when the time is over.
ProcessResult wait_for(pid_t child, double limit_seconds) {
  ProcessResult result;
  // glibc 2.36 declares pidfd_open without C linkage.
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  if (handle < 0) throw std::runtime_error("pidfd_open is not permitted here, so no time limit can be kept");
  pollfd waiting{handle, POLLIN, 0};
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(limit_seconds);
  int ready = -1;
  do {
    const double left = std::chrono::duration<double, std::milli>(end - Clock::now()).count();
    ready = poll(&waiting, 1, static_cast<int>(std::clamp(std::ceil(left), 0.0, 1e9)));
  } while (ready < 0 && errno == EINTR);
  close(handle);
  if (ready == 0) {
    result.timed_out = true;
    kill(-child, SIGKILL);
  }
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  kill(-child, SIGKILL);  // whatever it left behind
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  return result;
}

/// Reads the file that was given to the program, whatever now has its name.
std::string read_start_of(const Descriptor& file) {
  std::string text(longest_output, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got =
        pread(file.number(), text.data() + size, text.size() - size, static_cast<off_t>(size));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
  }
  text.resize(size);
  return text;
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() { make(std::filesystem::temp_directory_path().string(), ""); }

TemporaryDirectory::TemporaryDirectory(const std::string& parent) { make(parent, "."); }

void TemporaryDirectory::make(const std::string& parent, const std::string& prefix) {
  remove_leftovers(parent);
  std::string pattern = (std::filesystem::path(parent) / (prefix + temporary_name() + "XXXXXX")).string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error(pattern + ": no temporary directory: " + std::strerror(errno));
  }
  path_ = pattern;
  on_signal_.emplace(path_);
  claim_.emplace(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  claim_temporary(claim_->number());
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ProcessResult run_process(const std::vector<std::string>& command, const std::string& directory,
                          const ProcessLimits& limits, const std::vector<std::string>& variables) {
  const std::vector<char*> arguments = pointers(command);
  std::vector<std::string> all = variables;  // when a name is there twice, the first one counts
  all.insert(all.end(), {"HOME=" + directory, "PATH=/usr/bin:/bin", "LC_ALL=C", "TMPDIR=" + directory});
  const std::vector<char*> environment = pointers(all);
  const std::string output_path = directory + "/" + output_name;
  const Descriptor output(open(output_path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (output.number() < 0)
    throw std::runtime_error(output_path + ": cannot be written: " + std::strerror(errno));
  const pid_t child = fork();
  if (child == 0) become(arguments.data(), environment.data(), directory.c_str(), output.number(), limits);
  if (child < 0) throw std::runtime_error(command.front() + ": cannot be started: " + std::strerror(errno));
  ProcessResult result = wait_for(child, limits.seconds);
  result.output = read_start_of(output);
  return result;
}

std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string rest = path == nullptr ? "/usr/bin:/bin" : path;
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    const std::string candidate = std::filesystem::absolute(rest.substr(0, end) + "/" + name).string();
    if (access(candidate.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(candidate)) return candidate;
    rest = end == std::string::npos ? "" : rest.substr(end + 1);
  }
  return {};
}

}  // namespace plumb::system
