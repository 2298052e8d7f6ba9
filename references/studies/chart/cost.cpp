#include "references/studies/chart/cost.hpp"

#include <linux/perf_event.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

namespace plumb::studies {
namespace {

double seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double cpu_seconds_so_far() {
  timespec own{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &own);
  return static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec) + seconds_of_children();
}

}  // namespace

InstructionCounter::InstructionCounter() {
  perf_event_attr wanted{};
  wanted.type = PERF_TYPE_HARDWARE;
  wanted.size = sizeof wanted;
  wanted.config = PERF_COUNT_HW_INSTRUCTIONS;
  wanted.exclude_kernel = 1;
  wanted.exclude_hv = 1;
  wanted.inherit = 1;  // threads and children that are started from now on
  file_ = static_cast<int>(syscall(SYS_perf_event_open, &wanted, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
  if (file_ >= 0) return;
  complaint_ = std::strerror(errno);
  // After perf_event_open(2).
  if (errno == ENOENT || errno == EOPNOTSUPP)
    complaint_ = "this machine has no counter of instructions, as is usual for virtual ones";
  else if (errno == EACCES || errno == EPERM)
    complaint_ = "permission denied; try: sysctl kernel.perf_event_paranoid=1";
}

InstructionCounter::~InstructionCounter() {
  if (file_ >= 0) close(file_);
}

std::optional<std::uint64_t> InstructionCounter::read() const {
  std::uint64_t count = 0;
  if (file_ < 0 || ::read(file_, &count, sizeof count) != sizeof count) return std::nullopt;
  return count;
}

WorkCost cost_of(const std::function<void()>& work, const InstructionCounter& counter, double least_seconds) {
  const auto instructions = counter.read();
  const double begin = cpu_seconds_so_far();
  double passed = 0;
  std::uint64_t times = 0;
  do {
    work();
    ++times;
    passed = cpu_seconds_so_far() - begin;
  } while (passed < least_seconds);
  WorkCost cost{passed / static_cast<double>(times), std::nullopt};
  const auto end = counter.read();
  if (instructions && end) cost.instructions = (*end - *instructions) / times;
  return cost;
}

}  // namespace plumb::studies
