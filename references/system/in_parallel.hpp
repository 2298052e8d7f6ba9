// One piece of work for each index, on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace plumb::references {

/// Calls `work` with 0 to `count` - 1, from `threads` threads, the caller's among them (at least that). The
/// first exception keeps what is not begun from beginning, and is thrown when all threads are done.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace plumb::references
