// Scenes and tracers that no renderer can tell from the given ones: they differ by less than a reference
// resolves.
#pragma once

#include <cstddef>
#include <vector>

#include "references/attribution/perturbed_formulas.hpp"
#include "references/renderers/resolution.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::attribution {

/// The same world, in which every instance of a shared shape is one of its own, so that each can be moved
/// alone; or the scene as it is, when those would be more than 2,000.
Scene with_instances_apart(const Scene& scene);

/// Numbered patterns of moves: each sphere and each face of a box by the reference's step, one way or the
/// other, or by a thousandth of it. In some patterns a ray that only touches an edge takes the face that it
/// leaves by; what is as near to a lit point as casts no shadow in the reference casts none; or hits within a
/// step are one: not met at the start of a ray, and taken by chance elsewhere.
class Perturbation {
 public:
  /// All must outlive it. No shape is moved by more than 1e-5 of its size, and the step of the formulas is
  /// at most that of the smallest shape: in a scene with a vast sky nothing small is moved by what is
  /// visible.
  Perturbation(const Scene& scene, const Camera& camera, const renderers::Resolution& resolution);

  double extent() const { return extent_; }
  /// Returns how far the pattern moves, in steps.
  static double factor(int pattern);
  Scene moved(int pattern) const;
  Scene with_one_moved(ShapeId shape, int pattern) const;
  PerturbedFormulas formulas(int pattern) const;
  /// What is as near to a lit point as casts no shadow in the reference casts none.
  PerturbedFormulas reference_shadows() const;

 private:
  double nearest_blocker() const;

  const Scene& scene_;
  const renderers::Resolution& resolution_;
  double extent_;
  double step_;                // of the formulas, in world lengths
  std::vector<double> steps_;  // in the space of each shape
};

}  // namespace plumb::attribution
