#include "tests/bench/engine/embree/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace plumb::bench {
namespace {

/// The corners of a box are numbered by bits: 1 is max x, 2 max y, 4 max z.
constexpr std::uint32_t faces_of_box[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

template <class T>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& values,
          std::size_t per_item) {
  void* to =
      rtcSetNewGeometryBuffer(geometry, type, 0, format, per_item * sizeof(T), values.size() / per_item);
  if (to == nullptr) throw std::runtime_error("Embree has no memory for a buffer");
  std::memcpy(to, values.data(), values.size() * sizeof(T));
}

std::vector<std::uint32_t> quad_indices(std::size_t boxes) {
  std::vector<std::uint32_t> indices;
  indices.reserve(24 * boxes);
  for (std::size_t box = 0; box < boxes; ++box) {
    for (const auto& face : faces_of_box) {
      for (const std::uint32_t corner : face) indices.push_back(static_cast<std::uint32_t>(8 * box) + corner);
    }
  }
  return indices;
}

}  // namespace

double similarity_factor(const Mat4<double>& m) {
  const Vec3d x(m[0]), y(m[1]), z(m[2]);
  const double factor = glm::length(x);
  const double skew =
      std::max({std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z)), std::abs(glm::dot(z, x))});
  const double stretch = std::max(std::abs(glm::length(y) - factor), std::abs(glm::length(z) - factor));
  return skew < 1e-9 * factor * factor && stretch < 1e-9 * factor ? factor : 0;
}

void add_box(Group& group, const Box& box, const Mat4<double>& m) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                  (corner & 4) != 0 ? box.max.z : box.min.z);
    const Vec3d placed = formulas::transform_point(m, p);
    for (int axis = 0; axis < 3; ++axis) group.corners.push_back(static_cast<float>(placed[axis]));
  }
  group.quad_materials.insert(group.quad_materials.end(), 6, static_cast<std::int32_t>(box.material));
}

void add_sphere(Group& group, const Sphere& sphere, const Mat4<double>& m, double factor) {
  const Vec3d center = formulas::transform_point(m, sphere.center);
  for (int axis = 0; axis < 3; ++axis) group.spheres.push_back(static_cast<float>(center[axis]));
  group.spheres.push_back(static_cast<float>(factor * sphere.radius));
  group.sphere_materials.push_back(static_cast<std::int32_t>(sphere.material));
}

void attach_geometry(RTCScene scene, RTCGeometry geometry, unsigned number) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, number);
  rtcReleaseGeometry(geometry);
}

void attach_primitives(RTCDevice device, RTCScene scene, const Group& group) {
  if (!group.spheres.empty()) {
    const RTCGeometry spheres = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    fill(spheres, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, group.spheres, 4);
    attach_geometry(scene, spheres, sphere_geometry);
  }
  if (!group.corners.empty()) {
    const RTCGeometry quads = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    fill(quads, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, group.corners, 3);
    fill(quads, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, quad_indices(group.corners.size() / 24), 4);
    attach_geometry(scene, quads, quad_geometry);
  }
}

}  // namespace plumb::bench
