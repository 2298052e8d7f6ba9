// What a right tracer that computes in float32 may be off by.
#pragma once

#include <vector>

#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// because another order of the same operations rounds otherwise
inline constexpr float other_tracer = 4;
/// because what float32 is off by more at is another surface or another light
inline constexpr float most_of_an_error = 1e-3F;

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
/// box is moved by what float32 rounds at its distance, and faces at one coordinate by the same.
class FloatMoves {
 public:
  /// The scene's instances are taken apart; see with_instances_apart().
  FloatMoves(const Scene& scene, const Camera& camera);

  /// Number 0 moves nothing.
  Scene moved(int number) const;

 private:
  Scene scene_;
  std::vector<Vec3d> steps_;  // of spheres the step, of boxes what stands beside a face's coordinate
};

}  // namespace plumb::references
