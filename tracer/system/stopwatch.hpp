// Measures how long something takes.
#pragma once

#include <ctime>

namespace plumb::engine {

/// Seconds on the clock, and seconds of CPU of all threads together.
struct Seconds {
  double wall = 0, cpu = 0;
};

class Stopwatch {
 public:
  Seconds elapsed() const {
    const Seconds end = now();
    return {end.wall - start_.wall, end.cpu - start_.cpu};
  }

 private:
  static Seconds now() { return {read(CLOCK_MONOTONIC), read(CLOCK_PROCESS_CPUTIME_ID)}; }
  static double read(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
  }

  Seconds start_ = now();
};

}  // namespace plumb::engine
