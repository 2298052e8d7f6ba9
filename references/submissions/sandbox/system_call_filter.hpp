// The system calls that a confined program may not make, as a filter program for the kernel (seccomp(2)).
#pragma once

#include <linux/filter.h>

#include <vector>

namespace plumb::submissions {

/// Refused calls fail with EPERM: mounts, namespaces, tracing, keys, modules, clocks, io_uring and the like.
/// Calls for which libraries have a substitute fail with ENOSYS: clone3, and, unless `memory_is_counted`,
/// memory that no process need map (memfd, System V).
std::vector<sock_filter> system_call_filter(bool memory_is_counted);

}  // namespace plumb::submissions
