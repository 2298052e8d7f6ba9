#include "tracer/textbook/rows.hpp"

#include <algorithm>
#include <mutex>

#include "tracer/system/in_parallel.hpp"

namespace plumb::textbook {

int threads_for(const RenderJob& job) {
  return std::clamp(job.threads > 0 ? job.threads : processors(), 1, job.height);
}

std::function<void(double)> progress_of_band(const RenderJob& job, int first_row, int rows) {
  if (!job.progress) return {};
  return
      [&job, first_row, rows](double fraction) { job.progress((first_row + fraction * rows) / job.height); };
}

void for_each_row(int height, int threads, const std::function<void(double)>& progress,
                  const std::function<void(int)>& row) {
  std::mutex mutex;
  int done = 0;
  in_parallel(static_cast<std::size_t>(height), threads, [&](std::size_t y) {
    row(static_cast<int>(y));
    if (!progress) return;
    const std::lock_guard lock(mutex);
    progress(static_cast<double>(++done) / height);
  });
}

}  // namespace plumb::textbook
