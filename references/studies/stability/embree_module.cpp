// Single intersections by Embree 3, behind a C interface: a module of its own, so that plumb starts without
// it and says so where it is missing. Positions and directions are x y z; t counts in direction lengths and
// is infinite where nothing is met.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>

namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

RTCDevice device() {
  static const Owned<RTCDevice> one(rtcNewDevice("threads=1"));
  return one.get();
}

Owned<RTCScene> scene_of(RTCGeometry geometry) {
  Owned<RTCScene> scene(rtcNewScene(device()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcCommitScene(scene.get());
  return scene;
}

Owned<RTCScene> sphere_scene(const float* center, float radius) {
  const Owned<RTCGeometry> sphere(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_SPHERE_POINT));
  auto* const vertex = static_cast<float*>(rtcSetNewGeometryBuffer(sphere.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                                                   RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  std::copy(center, center + 3, vertex);
  vertex[3] = radius;
  return scene_of(sphere.get());
}

RTCRayHit hit_of(const Owned<RTCScene>& scene, const float* origin, const float* direction) {
  RTCRayHit asked{};
  asked.ray.org_x = origin[0];
  asked.ray.org_y = origin[1];
  asked.ray.org_z = origin[2];
  asked.ray.dir_x = direction[0];
  asked.ray.dir_y = direction[1];
  asked.ray.dir_z = direction[2];
  asked.ray.tfar = nothing;
  asked.ray.mask = ~0U;
  asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene.get(), &context, &asked);
  return asked;
}

float t_of(const RTCRayHit& asked) {
  if (asked.hit.geomID == RTC_INVALID_GEOMETRY_ID) return nothing;
  return asked.ray.tfar;
}

}  // namespace

extern "C" {

[[gnu::visibility("default")]] const char* plumb_embree_version() { return "Embree " RTC_VERSION_STRING; }

[[gnu::visibility("default")]] float plumb_embree_sphere(const float* origin, const float* direction,
                                                         const float* center, float radius) {
  return t_of(hit_of(sphere_scene(center, radius), origin, direction));
}

/// Embree has no boxes: six quadrilaterals, numbered as Face.
[[gnu::visibility("default")]] float plumb_embree_box(const float* origin, const float* direction,
                                                      const float* low, const float* high, int* face) {
  const Owned<RTCGeometry> box(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_QUAD));
  auto* const vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(box.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 8));
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis)
      vertices[3 * corner + axis] = ((corner >> axis) & 1U) != 0 ? high[axis] : low[axis];
  }
  constexpr std::array<unsigned, 24> faces{0, 2, 6, 4, 1, 3, 7, 5, 0, 1, 5, 4,
                                           2, 3, 7, 6, 0, 1, 3, 2, 4, 5, 7, 6};
  auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      box.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), 6));
  std::copy(faces.begin(), faces.end(), indices);
  const RTCRayHit hit = hit_of(scene_of(box.get()), origin, direction);
  *face = static_cast<int>(hit.hit.primID);
  return t_of(hit);
}

/// A unit sphere moved by a 4 x 4 matrix, column by column.
[[gnu::visibility("default")]] float plumb_embree_placed_sphere(const float* origin, const float* direction,
                                                                const float* world_from_object) {
  constexpr std::array<float, 3> middle{};
  const Owned<RTCScene> sphere = sphere_scene(middle.data(), 1);
  const Owned<RTCGeometry> instance(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(instance.get(), sphere.get());
  rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, world_from_object);
  return t_of(hit_of(scene_of(instance.get()), origin, direction));
}
}
