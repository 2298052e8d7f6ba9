// The loop over a picture's rows, whatever traces its pixels.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include "tracer/textbook/render.hpp"

namespace plumb::textbook {

/// How many threads a job takes: as many as it asks for, or as the machine runs, and no more than rows.
int threads_for(const RenderJob& job);

/// The job's progress from that of one of its bands; empty when the job's is.
std::function<void(double)> progress_of_band(const RenderJob& job, int first_row, int rows);

/// Runs `row(y)` for all rows on several threads; the first exception ends all and is thrown again.
void for_each_row(int height, int threads, const std::function<void(double)>& progress,
                  const std::function<void(int)>& row);

/// Hands on the picture that a tracer's raycast(x, y) gives, in float32, band by band.
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

/// The same, whole.
template <class AnyTracer>
Image render_rows(const AnyTracer& tracer, const RenderJob& job) {
  return in_one_band(job.height, [&](const BandSink& sink) { render_bands(tracer, job, sink); });
}

}  // namespace plumb::textbook
