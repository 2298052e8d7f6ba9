// What a tracer reports while it follows a ray, for those who want to see the ray tree of a pixel.
#pragma once

#include <cstddef>

#include "tracer/textbook/shape.hpp"

namespace plumb::textbook {

/// An `unbent` ray goes on through a surface between media of one refractive index, in the same depth.
enum class RayKind { camera, mirrored, refracted, totally_reflected, unbent };

/// What one light does at a point. `delta` is 0 where the light is hidden or does not count.
template <class Real>
struct LightSeen {
  Real cos_theta;  ///< n . l
  Real distance;   ///< from the point to the light
  bool counts;     ///< true if light_counts(n . l); what follows is set only then
  Rgb<Real> delta{0};
  Hit<Real> blocker{};      ///< the first that was found; of no instance when none was
  Real specular_factor{0};  ///< (r . v)^m
};

/// Sees nothing and costs nothing. Other observers have the same members. A ray that `ray_begins` refuses is
/// not followed: it is black, and `ray_ends` is not called.
template <class Real>
struct NoObserver {
  bool ray_begins(RayKind, const Ray<Real>&, int /*depth*/) const { return true; }
  void is_black_at_depth_limit() const {}
  void meets(const Hit<Real>&, const Surface<Real>&, const Vec3<Real>& /*point*/,
             const Vec3<Real>& /*normal*/) const {}
  void is_lit_by(std::size_t /*light*/, const LightSeen<Real>&) const {}
  void ray_ends(const Rgb<Real>& /*colour*/) const {}
};

}  // namespace plumb::textbook
