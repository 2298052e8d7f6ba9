#include "references/submissions/sandbox/system_call_filter.hpp"

#include <linux/audit.h>
#include <linux/seccomp.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace plumb::submissions {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t own_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t own_architecture = AUDIT_ARCH_AARCH64;
#else
#error "the filter of system calls is written for x86-64 and 64-bit ARM"
#endif

constexpr std::uint32_t x32_calls = 0x40000000;  // of x86-64: the same calls under other numbers
constexpr std::uint32_t namespaces =
    0x7e020000;  // clone(2): all CLONE_NEW... except time, which only clone3 has
constexpr std::uint32_t any_personality = 0xffffffff;  // personality(2): asks, changes nothing

constexpr std::uint32_t refused[] = {
    // other views of files
    __NR_mount,
    __NR_umount2,
    __NR_pivot_root,
    __NR_chroot,
    __NR_move_mount,
    __NR_open_tree,
    __NR_fsopen,
    __NR_fsconfig,
    __NR_fsmount,
    __NR_fspick,
    __NR_mount_setattr,
    __NR_unshare,
    __NR_setns,
    __NR_open_by_handle_at,
    __NR_name_to_handle_at,
    __NR_quotactl,
    __NR_fanotify_init,
    __NR_acct,
    // other processes
    __NR_ptrace,
    __NR_process_vm_readv,
    __NR_process_vm_writev,
    __NR_process_madvise,
    __NR_kcmp,
    __NR_pidfd_getfd,
    __NR_perf_event_open,
    __NR_migrate_pages,
    // parts of the kernel that need no privilege and had holes, or hold memory that nobody counts
    __NR_bpf,
    __NR_userfaultfd,
    __NR_io_uring_setup,
    __NR_io_uring_enter,
    __NR_io_uring_register,
    __NR_add_key,
    __NR_request_key,
    __NR_keyctl,
    __NR_vhangup,
    // the machine
    __NR_kexec_load,
    __NR_init_module,
    __NR_finit_module,
    __NR_delete_module,
    __NR_reboot,
    __NR_swapon,
    __NR_swapoff,
    __NR_settimeofday,
    __NR_clock_settime,
    __NR_adjtimex,
    __NR_clock_adjtime,
    __NR_sethostname,
    __NR_setdomainname,
    __NR_syslog,
#ifdef __NR_kexec_file_load
    __NR_kexec_file_load,
#endif
#ifdef __NR_memfd_secret
    __NR_memfd_secret,
#endif
#ifdef __NR_iopl
    __NR_iopl,
    __NR_ioperm,
    __NR_modify_ldt,
    __NR_uselib,
#endif
};

constexpr std::uint32_t uncounted_memory[] = {__NR_memfd_create, __NR_shmget, __NR_msgget, __NR_semget};

constexpr std::uint32_t failing(int error) { return SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error); }

class Filter {
 public:
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
  void answer(std::uint32_t action) { add(BPF_RET | BPF_K, action); }
  /// Ends the filter with the action when what was loaded compares as `jump` says (BPF_JEQ, BPF_JGE,
  /// BPF_JSET).
  void answer_if(unsigned jump, std::uint32_t value, std::uint32_t action) {
    all_.push_back({static_cast<std::uint16_t>(BPF_JMP | BPF_K | jump), 0, 1, value});
    answer(action);
  }
  void skip_if(std::uint32_t value, std::uint8_t count) {
    all_.push_back({BPF_JMP | BPF_JEQ | BPF_K, count, 0, value});
  }
  void skip_unless(std::uint32_t value, std::uint8_t count) {
    all_.push_back({BPF_JMP | BPF_JEQ | BPF_K, 0, count, value});
  }
  std::vector<sock_filter> all() const { return all_; }

 private:
  void add(unsigned code, std::uint32_t value) {
    all_.push_back({static_cast<std::uint16_t>(code), 0, 0, value});
  }
  std::vector<sock_filter> all_;
};

/// The lower half of the first argument; both machines are little-endian.
constexpr std::size_t first_argument = offsetof(seccomp_data, args);

}  // namespace

std::vector<sock_filter> system_call_filter(bool memory_is_counted) {
  Filter filter;
  filter.load(offsetof(seccomp_data, arch));
  filter.skip_if(own_architecture, 1);
  filter.answer(failing(ENOSYS));
  filter.load(offsetof(seccomp_data, nr));
  filter.answer_if(BPF_JGE, x32_calls, failing(ENOSYS));
  for (const std::uint32_t call : refused) filter.answer_if(BPF_JEQ, call, failing(EPERM));
  filter.answer_if(BPF_JEQ, __NR_clone3, failing(ENOSYS));  // its flags lie where a filter does not see them
  if (!memory_is_counted)
    for (const std::uint32_t call : uncounted_memory) filter.answer_if(BPF_JEQ, call, failing(ENOSYS));
  filter.skip_unless(__NR_clone, 4);
  filter.load(first_argument);
  filter.answer_if(BPF_JSET, namespaces, failing(EPERM));
  filter.answer(SECCOMP_RET_ALLOW);
  filter.skip_unless(__NR_personality, 4);
  filter.load(first_argument);
  filter.answer_if(BPF_JEQ, any_personality, SECCOMP_RET_ALLOW);
  filter.answer(failing(EPERM));
  filter.answer(SECCOMP_RET_ALLOW);
  return filter.all();
}

}  // namespace plumb::submissions
