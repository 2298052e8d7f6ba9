#include "tracer/image/decoder/confinement.hpp"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace plumb::decoder {
namespace {

// Sanitizers reserve terabytes and need calls that are forbidden, so builds with them are not confined.
#ifdef __SANITIZE_ADDRESS__
constexpr bool has_sanitizers = true;
#else
constexpr bool has_sanitizers = false;
#endif

void limit(int what, std::uint64_t value) {
  const rlimit both{value, value};
  if (::setrlimit(static_cast<__rlimit_resource>(what), &both) != 0)
    throw std::runtime_error("a limit of the decoder cannot be set");
}

std::uint64_t mapped_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// The calls for allocation, the end of a process, and reading and writing open files.
constexpr std::array allowed{
    SYS_read,         SYS_write,        SYS_pread64,     SYS_pwrite64,       SYS_readv,     SYS_writev,
    SYS_lseek,        SYS_close,        SYS_fstat,       SYS_newfstatat,     SYS_ftruncate, SYS_mmap,
    SYS_munmap,       SYS_mremap,       SYS_mprotect,    SYS_madvise,        SYS_brk,       SYS_futex,
    SYS_rt_sigaction, SYS_rt_sigreturn, SYS_sigaltstack, SYS_rt_sigprocmask, SYS_getpid,    SYS_gettid,
    SYS_tgkill,       SYS_exit,         SYS_exit_group,  SYS_clock_gettime,  SYS_getrandom, SYS_sched_yield,
    SYS_getrusage,
};

sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
sock_filter give(std::uint32_t action) { return BPF_STMT(BPF_RET | BPF_K, action); }
/// Goes on with the next instruction, or skips it when the number differs.
sock_filter skip_unless(std::uint32_t number) { return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1); }

}  // namespace

void limit_resources(int seconds, std::uint64_t memory_bytes, std::uint64_t file_bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::uint64_t>(seconds));
  limit(RLIMIT_FSIZE, file_bytes);
  if (!has_sanitizers) limit(RLIMIT_AS, mapped_bytes() + memory_bytes);
}

void forbid_all_else() {
  if (has_sanitizers) return;
  std::vector<sock_filter> program{load(offsetof(seccomp_data, arch)), skip_unless(AUDIT_ARCH_X86_64),
                                   load(offsetof(seccomp_data, nr))};
  // For another architecture, the number that is compared stays that of the architecture, which no call has.
  for (const long call : allowed) {
    program.push_back(skip_unless(static_cast<std::uint32_t>(call)));
    program.push_back(give(SECCOMP_RET_ALLOW));
  }
  program.push_back(give(SECCOMP_RET_ERRNO | EPERM));
  const sock_fprog all{static_cast<unsigned short>(program.size()), program.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &all) != 0)
    throw std::runtime_error("the decoder cannot be confined (seccomp)");
}

}  // namespace plumb::decoder
