// What a process that decodes other people's bytes may still do.
#pragma once

#include <cstdint>

namespace plumb::decoder {

/// From now on: so much CPU, so much memory beyond what is loaded, files no longer than `file_bytes`, no
/// core.
void limit_resources(int seconds, std::uint64_t memory_bytes, std::uint64_t file_bytes);

/// From now on nothing but computing, memory, and reading and writing what is open already: any other system
/// call fails with EPERM. For good.
void forbid_all_else();

}  // namespace plumb::decoder
