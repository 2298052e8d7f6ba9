// Embree 3's intersections, as methods of the atlas. They are in float, the one real type that it has.
#pragma once

#include <optional>
#include <string>

#include "tracer/formulas/box.hpp"
#include "tracer/formulas/transform.hpp"

namespace plumb::studies::stability {

/// Returns e.g. "Embree 3.13.5"; empty when it is not on this machine.
const std::string& embree_version();

// Each makes a scene of one shape for one ray. All throw Unavailable when Embree is missing.

std::optional<float> embree_sphere(const Ray<float>& ray, const Vec3<float>& center, float radius,
                                   bool starts_on_it);
std::optional<FaceHit<float>> embree_box(const Ray<float>& ray, const Corners<float>& box, Face start);
/// A unit sphere as an instance.
std::optional<float> embree_placed_sphere(const Ray<float>& ray, const Mat4<float>& world_from_object);

}  // namespace plumb::studies::stability
