// Waits for threads that libraries start when they are loaded.
#pragma once

namespace plumb::decoder {

/// Returns when all other threads of this process sleep, at the latest after a second. A thread that is just
/// starting may hold a lock, which nobody would ever release in a forked process.
void wait_until_others_rest();

}  // namespace plumb::decoder
