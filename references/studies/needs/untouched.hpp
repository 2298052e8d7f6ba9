// What a picture does not need of its scene.
#pragma once

#include <vector>

#include "references/studies/needs/observed.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// Of the pixels that were observed: for this camera, this size and one sample a pixel.
struct Untouched {
  std::vector<ShapeId> shapes;        ///< spheres, boxes and composites of them that no ray touches
  std::vector<MaterialId> materials;  ///< that no ray meets
  std::vector<std::size_t> lights;    ///< that add nothing to any hit
};

/// Where glass filters the light, a shadow ray goes through it unnoticed: there glass counts as touched.
Untouched untouched_by(const Scene& scene, const Observed& observed, const RenderOptions& options);

/// The scene without these shapes and lights.
Scene without(const Scene& scene, const Untouched& untouched);

}  // namespace plumb::references
