// Finds lights that lie exactly on a surface, where rounding decides whether it hides them.
#pragma once

#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb {

struct LightOnSurface {
  std::size_t light;
  ShapeId shape;  ///< the first sphere or box of the world that it lies on
};

/// Returns the lights whose distance from a surface is zero within the rounding of the numbers that place it.
/// Leaves out lights that do not shine. Expects a scene without hierarchy errors. Returns nothing when lights
/// times instances are more than a million.
std::vector<LightOnSurface> lights_on_surfaces(const Scene& scene);

}  // namespace plumb
