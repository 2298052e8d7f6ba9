// A scene in which edges and regions tell the camera, and pictures of it.
#pragma once

#include <algorithm>
#include <cmath>

#include "references/faults/fault.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::tests {

inline constexpr const char* room_scene = R"(define material red 0.4 0.1 0.1 0.6 0.2 0.1 0.3 0.2 0.1 20
define material green 0.1 0.3 0.1 0.2 0.6 0.1 0.2 0.3 0.1 30
define material blue 0.1 0.1 0.4 0.1 0.2 0.6 0.1 0.2 0.3 20
define shape sphere ball -1 0.2 -5 1 red
define shape sphere small 1.3 1 -6 0.6 green
define shape box block 0.4 -1 -5.5 1.4 0 -4.5 blue
define shape box floor -3 -1.6 -8 2.5 -1.2 -3 green
define light key 4 6 2 1 1 1 1
ambient 0.2 0.2 0.2
background 0.1 0.15 0.3
define camera eye 50
transform eye rotate 12 0 1 0.3
transform eye translate 0.6 0.4 0.5
render eye out.ppm 150 100
)";

inline textbook::RenderJob job_of(int width, int height) {
  textbook::RenderJob job;
  job.width = width;
  job.height = height;
  job.threads = 1;
  return job;
}

/// The picture of the first camera, truncated to 8 bits as the course's framework does.
inline ImageFile picture_of(const Scene& scene, const textbook::RenderJob& job,
                            const std::vector<const faults::Fault*>& faults) {
  const Image image = faults::render_with(scene, scene.cameras.front(), job, faults);
  ImageFile file{image.width, image.height, 3, Sample::bits8, {}, {}};
  for (const float value : image.rgb)
    file.values.push_back(std::floor(255 * std::clamp(value, 0.0F, 1.0F)) / 255);
  return file;
}

}  // namespace plumb::tests
