// Which transmissive objects are around a point, for cameras inside glass.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb {

struct EnclosingDielectric {
  std::uint64_t instance;  ///< its place in the order of for_each_instance
  double eta;
};

/// The transmissive spheres and boxes that contain the point, outermost first: a ray from the point in the
/// given direction leaves them in the reverse order.
std::vector<EnclosingDielectric> dielectrics_around(const Scene& scene, const Vec3d& point,
                                                    const Vec3d& direction);

}  // namespace plumb
