// Random lecture scenes of a sane scale, with every feature of the lecture, the same for the same seed.
#pragma once

#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::tests {

struct RandomScene {
  Scene scene;
  RenderOptions options;
};

/// A few to 26 spheres and boxes about 1 unit in size within some 10 units, in composites with shared
/// children, mirrored, sheared and scaled; coloured lights; RGB coefficients; mirrors; nested glass;
/// sometimes the eye in it.
RandomScene random_scene(unsigned seed);

}  // namespace plumb::tests
