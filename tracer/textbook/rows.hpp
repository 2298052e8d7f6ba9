// The loop over a picture's rows, for any tracer of its pixels.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include "tracer/textbook/render.hpp"

namespace plumb::textbook {

/// Returns the number of threads for a job: as many as it asks for, else as the machine runs; at most one per
/// row.
int threads_for(const RenderJob& job);

/// Turns the progress of one band into that of the job, which must outlive it. Empty when the job's is.
std::function<void(double)> progress_of_band(const RenderJob& job, int first_row, int rows);

/// Calls `row(y)` for all rows, on several threads. After the first exception no new row starts; it is
/// rethrown when all threads have ended.
void for_each_row(int height, int threads, const std::function<void(double)>& progress,
                  const std::function<void(int)>& row);

/// Hands on, band by band, the float32 picture of what the tracer's raycast(x, y) returns.
template <class AnyTracer>
void render_bands(const AnyTracer& tracer, const RenderJob& job, const BandSink& sink) {
  const int rows = std::min(sink.rows, job.height);
  for (int first = 0; first < job.height; first += rows) {
    Image band(job.width, std::min(rows, job.height - first));
    for_each_row(band.height, threads_for(job), progress_of_band(job, first, band.height), [&](int y) {
      for (int x = 0; x < band.width; ++x) {
        const auto colour = tracer.raycast(x, first + y);
        for (int channel = 0; channel < 3; ++channel)
          band.pixel(x, y)[channel] = static_cast<float>(colour[channel]);
      }
    });
    sink.take(std::move(band));
  }
}

/// Returns the same picture at once.
template <class AnyTracer>
Image render_rows(const AnyTracer& tracer, const RenderJob& job) {
  return in_one_band(job.height, [&](const BandSink& sink) { render_bands(tracer, job, sink); });
}

}  // namespace plumb::textbook
