// The loop over a picture's rows, whatever traces its pixels.
#pragma once

#include <functional>

#include "tracer/textbook/render.hpp"

namespace plumb::textbook {

/// How many threads a job takes: as many as it asks for, or as the machine runs, and no more than rows.
int threads_for(const RenderJob& job);

/// Runs `row(y)` for all rows on several threads; the first exception ends all and is thrown again.
void for_each_row(int height, int threads, const std::function<void(double)>& progress,
                  const std::function<void(int)>& row);

/// The picture that a tracer's raycast(x, y) gives, in float32.
template <class AnyTracer>
Image render_rows(const AnyTracer& tracer, const RenderJob& job) {
  Image image(job.width, job.height);
  for_each_row(job.height, threads_for(job), job.progress, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const auto colour = tracer.raycast(x, y);
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] = static_cast<float>(colour[channel]);
    }
  });
  return image;
}

}  // namespace plumb::textbook
