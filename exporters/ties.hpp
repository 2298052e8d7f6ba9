// Writes surfaces that lie at one place so that another renderer decides between them as plumb does.
#pragma once

#include <variant>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb::exporters {

/// One sphere or box of the world as an export writes it.
struct PlacedShape {
  ShapeId shape;  ///< gives the name and the material
  std::variant<Sphere, Box> geometry;
  Transform<double> world_from_object;
  bool is_centered = false;  ///< world_from_object leads to the world moved by -center
};

/// Returns all spheres and boxes of the world, in the order in which plumb decides ties: the first is taken.
/// Throws what for_each_instance() throws.
std::vector<PlacedShape> placed_shapes(const Scene& scene);

/// Returns whether some shapes coincide where a ray can meet both at once, and writes all that coincide in
/// the same numbers. A renderer then finds exactly the same distance to each, and takes the first if it tries
/// them in their order. Faces are at one place when their planes are equal within the rounding of the numbers
/// that they come from. It finds identical spheres and ellipsoids, and faces of boxes without shear that have
/// the same edges, or one edge along an axis of the world, in common. `eye` is in world space; `center` is
/// that of the export.
bool write_ties_alike(const Scene& scene, const Vec3d& eye, const Vec3d& center,
                      std::vector<PlacedShape>& shapes);

}  // namespace plumb::exporters
