// Surfaces that lie at one place, written so that another renderer decides between them as plumb does.
#pragma once

#include <variant>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb::exporters {

/// One sphere or box of the world as an export writes it.
struct PlacedShape {
  ShapeId shape;  ///< has the name and the material
  std::variant<Sphere, Box> geometry;
  Transform<double> world_from_object;
  bool is_centered = false;  ///< world_from_object leads to the world about the centre of the export
};

/// All spheres and boxes of the world, in the order in which plumb decides ties: the first is taken.
std::vector<PlacedShape> placed_shapes(const Scene& scene);

/// Whether some of these coincide where a ray can meet both at once. If so, all that coincide are written in
/// the same numbers: a renderer then finds exactly the same distance to each, and takes the first if it tries
/// them in their order. Faces are at one place when their planes are equal within the rounding of the
/// numbers that they come from. Found are identical spheres and ellipsoids, and faces of boxes without shear
/// that have the same edges, or one edge along an axis of the world in common. `center` is that of the
/// export.
bool write_ties_alike(const Scene& scene, const Vec3d& eye, const Vec3d& center,
                      std::vector<PlacedShape>& shapes);

}  // namespace plumb::exporters
