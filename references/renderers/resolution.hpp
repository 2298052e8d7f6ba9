// What a renderer does not resolve: where a difference is a matter of chance, and no fault.
#pragma once

#include "tracer/scene/scene.hpp"

namespace plumb::renderers {

/// Lengths are shares of the extent.
struct Resolution {
  /// The length of a scene, in its own units, that the renderer's tolerances grow with.
  double (*extent)(const Scene& scene, const Camera& camera);
  double step;              ///< of two hits that are nearer to each other either may be taken
  double steps_to_blocker;  ///< what is nearer to a lit point, or to the light, casts no shadow there
  double touched_edge;      ///< of the way to a box: a ray that leaves it within so much touches its edge
  double one_place;         ///< surfaces that are nearer to each other along a ray are at one place
  double told_apart;        ///< what is farther from a lit point is another surface than its own
  double shadow;            ///< a blocker that is farther from point and light hides the light for certain
  /// Plumb made the picture: it differs from ours by roundings alone, so that neither another end of the
  /// recursion nor another answer to the scene's last digits is an excuse.
  bool is_of_plumb;
};

}  // namespace plumb::renderers
