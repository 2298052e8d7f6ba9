// Makes the kernel hand out the memory of large arrays in few pieces instead of many.
#pragma once

#include <sys/mman.h>

#include <cstdint>

namespace plumb {

/// Hints that memory which is reserved and not yet written to should come in pages of 2 MiB, where the system
/// has them. Does nothing when no such page fits into it.
inline void prefer_huge_pages(void* begin, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  const std::uintptr_t before_first = -reinterpret_cast<std::uintptr_t>(begin) & (page - 1);
  if (before_first + page > bytes) return;
  madvise(static_cast<char*>(begin) + before_first, (bytes - before_first) & ~(page - 1), MADV_HUGEPAGE);
#else
  static_cast<void>(begin);
  static_cast<void>(bytes);
#endif
}

}  // namespace plumb
