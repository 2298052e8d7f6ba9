// Looks at pixels of a picture, as many as a counted amount of work allows.
#pragma once

#include <cstddef>
#include <functional>

#include "references/comparison/comparison.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// All pixels of a picture, each once, so that the first n are spread evenly: steps of the golden section
/// from pixel to pixel (Knuth, "The Art of Computer Programming" 3, 1973, section 6.4, Theorem S).
class SpreadPixels {
 public:
  SpreadPixels(int width, int height);

  std::size_t size() const { return pixels_; }
  PixelPlace operator[](std::size_t i) const;

 private:
  std::size_t width_, pixels_, step_;
};

/// What may be spent; counted and not timed, so that every machine looks at the same pixels.
struct LookLimit {
  double most_units;    ///< a unit is a ray, or a shadow ray, against one sphere or box
  double units_of_ray;  ///< of one that is traced and lit by all lights
  int threads;
  std::function<void(double)> progress;  ///< with the fraction that is done; may be empty
};

double units_of_ray(const Scene& scene);

/// Calls `look(begin, end)`, which returns how many rays it traced, for pieces of 0..n in their order, on
/// several threads, until the limit is reached. Returns how many of the n were looked at: at least one.
std::size_t look_at(std::size_t n, const LookLimit& limit,
                    const std::function<double(std::size_t begin, std::size_t end)>& look);

}  // namespace plumb::references
