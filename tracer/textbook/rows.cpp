#include "tracer/textbook/rows.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace plumb::textbook {

int threads_for(const RenderJob& job) {
  const int available = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return std::clamp(job.threads > 0 ? job.threads : available, 1, job.height);
}

std::function<void(double)> progress_of_band(const RenderJob& job, int first_row, int rows) {
  if (!job.progress) return {};
  return
      [&job, first_row, rows](double fraction) { job.progress((first_row + fraction * rows) / job.height); };
}

void for_each_row(int height, int threads, const std::function<void(double)>& progress,
                  const std::function<void(int)>& row) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  int done = 0;
  const auto work = [&] {
    try {
      for (int y = next++; y < height; y = next++) {
        row(y);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress(static_cast<double>(done) / height);
      }
    } catch (...) {
      next = height;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace plumb::textbook
