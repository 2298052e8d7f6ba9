// Finds what a picture does not need of its scene.
#pragma once

#include <vector>

#include "references/studies/needs/observed.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::studies {

/// Holds for the pixels that were observed: this camera, this size and one sample per pixel.
struct Untouched {
  std::vector<ShapeId> shapes;        ///< spheres and boxes, and composites of such, that no ray touches
  std::vector<MaterialId> materials;  ///< those that no ray meets
  std::vector<std::size_t> lights;    ///< those that add nothing to any hit
};

/// Where glass filters the light, a shadow ray passes it unnoticed, so glass counts as touched there.
Untouched untouched_by(const Scene& scene, const Observed& observed, const RenderOptions& options);

/// Returns the scene without these shapes and lights.
Scene without(const Scene& scene, const Untouched& untouched);

}  // namespace plumb::studies
