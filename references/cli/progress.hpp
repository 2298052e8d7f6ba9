// Shows the progress of long work: a line that is drawn over, on a terminal only.
#pragma once

#include <chrono>
#include <string>

namespace plumb::cli {

class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Draws the fraction that is done, 0 to 1: at most ten times a second, and nothing in the first second.
  void show(double fraction);
  /// Removes the line, for other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool is_terminal_;
  bool is_drawn_ = false;
  Clock::time_point begin_;
  Clock::time_point last_;
};

}  // namespace plumb::cli
