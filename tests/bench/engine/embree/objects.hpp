// A scene as Embree takes it: sphere points and quads, composites with several parents as instances.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb::bench {

/// Geometry numbers in every RTCScene; instance i of the world has number first_instance + i.
inline constexpr unsigned sphere_geometry = 0;
inline constexpr unsigned quad_geometry = 1;
inline constexpr unsigned first_instance = 2;

/// What shading looks up by a hit. Slot 0 is the world itself, slot i + 1 its instance i.
struct Objects {
  std::vector<std::int32_t> material;            ///< of every primitive; six quads a box
  std::vector<std::int32_t> first_primitive[2];  ///< by slot: of its spheres, of its quads, in `material`
  std::vector<float> normal_matrix[9];           ///< by slot: (M^-1)^T by rows
  bool has_instances = false;
};

/// Owns the device and all scenes.
class EmbreeScene {
 public:
  /// Builds on `threads` threads. Throws std::runtime_error on what Embree reports, and on an ellipsoid
  /// inside an instance, for Debian's Embree has one level of instances.
  EmbreeScene(const Scene& scene, int threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene world() const { return scenes_.front(); }
  const Objects& objects() const { return objects_; }
  std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }  ///< that Embree holds

 private:
  friend class SceneBuilder;
  RTCDevice device_;
  std::vector<RTCScene> scenes_;  // the world first
  Objects objects_;
  std::int64_t bytes_ = 0;
};

}  // namespace plumb::bench
