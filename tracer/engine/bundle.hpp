// Several rays as one: linear bounds of where they are at each t.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracer/engine/compiled_scene.hpp"

namespace plumb::engine {

/// Bounds of origins and directions, in the space of a group.
struct RayBounds {
  Vec3<double> origin_min{std::numeric_limits<double>::infinity()};
  Vec3<double> origin_max{-std::numeric_limits<double>::infinity()};
  Vec3<double> slope_min{std::numeric_limits<double>::infinity()};
  Vec3<double> slope_max{-std::numeric_limits<double>::infinity()};
  double reach = 0;  ///< how far beside its way a ray may find what is at one place with it
};

/// Along each axis, every ray of a bundle is between the lines low(t) and high(t). So it can only meet a box
/// with low(t) <= max and high(t) >= min for some t: six half-lines of t (interval arithmetic as in Boulos,
/// Wald, Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets", 2006; for one ray it is
/// the slab test of Kay and Kajiya, 1986). All numbers are float, in the units of a group, rounded outward.
class Bundle {
 public:
  struct HalfLine {
    float origin, per_slope;
    std::uint32_t plane;  ///< index of a node's plane
  };

  Bundle(const RayBounds& rays, const Group& group) {
    const Vec3<double> low = (rays.origin_min - rays.reach - group.center) * group.scale;
    const Vec3<double> high = (rays.origin_max + rays.reach - group.center) * group.scale;
    const Vec3<double> low_slope = rays.slope_min * group.scale;
    const Vec3<double> high_slope = rays.slope_max * group.scale;
    double steepest = 1e-300;
    for (int k = 0; k < 3; ++k)
      steepest = std::max({steepest, std::abs(low_slope[k]), std::abs(high_slope[k])});
    t_scale_ = steepest;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::uint32_t>(k);
      const float low_slope_k = down(low_slope[k] / steepest), high_slope_k = up(high_slope[k] / steepest);
      // A slope of nearly 0 is replaced by one that is safely not 0, so that nothing is divided by 0.
      const float low_1 = std::abs(low_slope_k) < tiny ? -tiny : low_slope_k;
      const float high_1 = std::abs(high_slope_k) < tiny ? tiny : high_slope_k;
      add({down(low[k]), 1 / low_1, axis + 3}, low_1 < 0);
      add({up(high[k]), 1 / high_1, axis}, high_1 > 0);
    }
  }

  /// Tells that no ray looks beyond t. Keeps a little more, for rounding and for what counts as one place.
  void limit(double t) { t_max = up(t * t_scale_ * 1.00002); }

  HalfLine line[6];  ///< those by which a box is entered come first
  std::uint32_t enters = 0;
  float t_max = std::numeric_limits<float>::infinity();

 private:
  /// Return a float that is not greater (smaller) than x: farther by two of its roundings.
  static float down(double x) { return static_cast<float>(x - std::abs(x) * 0x1p-23 - 1e-35); }
  static float up(double x) { return static_cast<float>(x + std::abs(x) * 0x1p-23 + 1e-35); }

  void add(const HalfLine& of, bool is_entered) { line[is_entered ? enters++ : --leaves_from_] = of; }

  static constexpr float tiny = 1e-18F;
  double t_scale_;
  std::uint32_t leaves_from_ = 6;
};

}  // namespace plumb::engine
