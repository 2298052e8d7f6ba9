// Measures what a piece of work costs, apart from the time that passes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace plumb::studies {

struct WorkCost {
  double cpu_seconds = 0;  ///< user and system, of all threads and of children that have ended
  std::optional<std::uint64_t> instructions;  ///< in user mode; nothing where the machine cannot count them
};

/// Counts the instructions of this process and of the children it starts, by Linux's perf_event_open(2).
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  /// Says why nothing is counted; empty when something is. Containers and virtual machines often have no
  /// counters.
  const char* complaint() const { return file_ < 0 ? complaint_ : ""; }
  /// Returns the count so far; nothing where the machine cannot count.
  std::optional<std::uint64_t> read() const;

 private:
  int file_ = -1;
  const char* complaint_ = "";
};

/// Repeats the work until it took `least_seconds` of CPU time, and returns the mean: clocks are coarse, and
/// small pictures take less than a millisecond.
WorkCost cost_of(const std::function<void()>& work, const InstructionCounter& counter, double least_seconds);

}  // namespace plumb::studies
