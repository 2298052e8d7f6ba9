// Threads that libraries start when they are loaded.
#pragma once

namespace plumb::decoder {

/// Returns when all other threads of this process sleep, at the latest after a second: one that just starts
/// may hold a lock, and in a process that is forked then nobody would ever release it.
void wait_until_others_rest();

}  // namespace plumb::decoder
