// Tells how far a right tracer that computes in float32 may be off.
#pragma once

#include <vector>

#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::diagnosis {

/// So many times an error counts, because another order of the same operations rounds otherwise.
inline constexpr float other_tracer = 4;
/// An error is at most this, because what float32 changes by more is another surface or another light.
inline constexpr float most_of_an_error = 1e-3F;

/// How far the colour of each pixel may be off in float32, relative above 1, row by row.
struct FloatErrors {
  /// Four times what a render in float32 is off by at the pixel or a neighbour, at most 1e-3. What jumps by
  /// more is a matter of moves, not of errors.
  std::vector<float> measured;
  /// The same, but at least four times what nine of ten pixels are below, within 1e-6 (as `compare` allows)
  /// and 1e-5.
  std::vector<float> allowed;
};

/// Measures between two renders of the picture, one of which is `in_double`.
FloatErrors float_errors(const Scene& scene, const Camera& camera, const RenderJob& job,
                         const Image& in_double);

/// Makes scenes that a tracer in float32 cannot tell from a given one, by number. It moves each sphere and
/// each face of a box by what float32 rounds at its distance, and faces at one coordinate by the same.
class FloatMoves {
 public:
  /// Takes the scene's instances apart; see with_instances_apart().
  FloatMoves(const Scene& scene, const Camera& camera);

  /// Returns the scene of that number; number 0 moves nothing.
  Scene moved(int number) const;

 private:
  Scene scene_;
  std::vector<Vec3d> steps_;  // a sphere's step; for a box, what is rounded beside a face's own coordinate
};

}  // namespace plumb::diagnosis
