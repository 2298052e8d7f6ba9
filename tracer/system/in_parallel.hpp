// One piece of work for each index, on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace plumb {

/// Number of threads that the machine runs at once, at least 1.
int processors();

/// Calls `work` with 0 to `count` - 1, from `threads` threads, the caller's among them (at least that), and
/// no more than `count`. After the first exception no new index starts; it is thrown again when all threads
/// have ended.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace plumb
