// Spheres and boxes on their way to Embree.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/engine/embree/objects.hpp"

namespace plumb::bench {

/// Spheres and boxes of one RTCScene, ready to be copied.
struct Group {
  std::vector<float> spheres;  // x y z r
  std::vector<float> corners;  // x y z, eight a box
  std::vector<std::int32_t> sphere_materials;
  std::vector<std::int32_t> quad_materials;  // six a box
};

/// The factor of a similarity, 0 for another map.
double similarity_factor(const Mat4<double>& m);

/// Adds a box under any affine map, as six quads.
void add_box(Group& group, const Box& box, const Mat4<double>& m);

/// Adds a sphere under a similarity of that factor.
void add_sphere(Group& group, const Sphere& sphere, const Mat4<double>& m, double factor);

/// Takes the geometry over.
void attach_geometry(RTCScene scene, RTCGeometry geometry, unsigned number);

/// Copies a group into a scene. Throws std::runtime_error when there is no memory.
void attach_primitives(RTCDevice device, RTCScene scene, const Group& group);

}  // namespace plumb::bench
