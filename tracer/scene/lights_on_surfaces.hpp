// Lights that lie exactly on a surface: whether it hides them is left to rounding.
#pragma once

#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb {

struct LightOnSurface {
  std::size_t light;
  ShapeId shape;  ///< the first sphere or box of the world that it lies on
};

/// Those whose distance from a surface is nothing within the rounding of the numbers that place it. Lights
/// that do not shine are left out. Expects a scene without hierarchy errors. Looks at nothing when that would
/// be more than a million instances, once for each light.
std::vector<LightOnSurface> lights_on_surfaces(const Scene& scene);

}  // namespace plumb
