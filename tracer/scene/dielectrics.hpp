// Finds the transmissive objects around the eye, for cameras inside glass.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb {

struct EnclosingDielectric {
  std::uint64_t instance;  ///< its place in the order of for_each_instance
  double eta;
};

/// Returns the transmissive spheres and boxes that contain the point, outermost first. A ray from the point
/// in the given direction leaves them in the reverse order.
std::vector<EnclosingDielectric> dielectrics_around(const Scene& scene, const Vec3d& point,
                                                    const Vec3d& direction);

/// Gives the same for all rays from one eye, in the real type that traces them. A ray is inside of what it
/// leaves before it enters it. What it meets up to t_min does not count (see formulas::resolution). So an eye
/// that lies on a surface, by all that rounding can tell, is inside for the rays that go in, and outside for
/// those that go out.
template <class Real>
class DielectricsAroundEye {
 public:
  /// The scene must outlive this object. The camera looks in `direction`, of any length.
  DielectricsAroundEye(const Scene& scene, const Vec3<Real>& eye, const Vec3<Real>& direction);
  ~DielectricsAroundEye();
  DielectricsAroundEye(DielectricsAroundEye&&) noexcept;

  /// The answer for the ray along which the camera looks. It holds for every ray, unless the eye lies on a
  /// surface.
  const std::vector<EnclosingDielectric>& ahead() const { return ahead_; }
  bool is_on_surface() const { return search_ != nullptr; }
  /// Returns the t up to which a hit cannot be told from the eye, because of the glass that it lies on; 0
  /// when it lies on none.
  Real t_min() const;
  /// Returns the answer for one ray, outermost first. The direction is a unit vector in world space.
  std::vector<EnclosingDielectric> of_ray(const Vec3<Real>& direction) const;

 private:
  class Search;

  std::unique_ptr<Search> search_;  ///< null when all rays have one answer
  std::vector<EnclosingDielectric> ahead_;
};

}  // namespace plumb
