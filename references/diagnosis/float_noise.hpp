// What a right tracer that computes in float32 may be off by.
#pragma once

#include <vector>

#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// What the colour of each pixel may be off by in float32, relative above 1, row by row.
struct FloatErrors {
  /// Four times what a render in float32 is off by at the pixel or a neighbour, 1e-3 at most: what jumps by
  /// more is no matter of errors, but of moves.
  std::vector<float> measured;
  /// The same, and at least 1e-6, as `compare` allows, or what most pixels are off by, up to 1e-5.
  std::vector<float> allowed;
};

/// Measured between two renders of the picture, of which `in_double` is one.
FloatErrors float_errors(const Scene& scene, const Camera& camera, const RenderJob& job,
                         const Image& in_double);

/// Scenes that a tracer in float32 cannot tell from a given one, by number: each sphere and each face of a
/// box is moved by what float32 rounds at its distance.
class FloatMoves {
 public:
  /// The scene's instances are taken apart; see with_instances_apart().
  FloatMoves(const Scene& scene, const Camera& camera);

  /// Number 0 moves nothing.
  Scene moved(int number) const;
  /// Whether it moves by no more than what float32 rounds once or twice, not by what it rounds in all.
  static bool is_small(int number);

 private:
  Scene scene_;
  std::vector<double> steps_;  // in the space of each shape
};

}  // namespace plumb::references
