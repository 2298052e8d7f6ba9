// Random scenes in which much lies at one place, and lengths are of every size; the same for the same seed.
#pragma once

#include "tests/support/random_scene.hpp"

namespace plumb::tests {

/// One to eight spheres and boxes on a grid, so that faces, edges and corners coincide, and rays through
/// pixel centres meet them exactly; the same shape twice; plates of no thickness; composites with shared
/// children, at the same place, or turned by right angles, mirrored, and flattened by up to 1e-8; nested
/// glass, also of eta below 1 and of exactly 1; lights and the eye on surfaces, on edges and in glass.
/// Everything is scaled by 1e-8 to 1e8, in its numbers or by a transform; sometimes a speck or a sky of
/// another size is added.
RandomScene nasty_scene(unsigned seed);

}  // namespace plumb::tests
