// Confines a process that decodes other people's bytes.
#pragma once

#include <cstdint>

namespace plumb::decoder {

/// From this call on the process may use this much CPU and this much memory beyond what is loaded, write no
/// file longer than `file_bytes`, and leave no core. It dies with its parent.
void limit_resources(int seconds, std::uint64_t memory_bytes, std::uint64_t file_bytes);

/// From this call on, for good, the process may only compute, use memory, and read and write what is open
/// already. Any other system call fails with EPERM.
void forbid_all_else();

}  // namespace plumb::decoder
