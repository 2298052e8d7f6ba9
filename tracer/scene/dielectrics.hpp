// Which transmissive objects are around the eye, for cameras inside glass.
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

/// The transmissive spheres and boxes that contain the point, outermost first: a ray from the point in the
/// given direction leaves them in the reverse order.
std::vector<EnclosingDielectric> dielectrics_around(const Scene& scene, const Vec3d& point,
                                                    const Vec3d& direction);

/// The same for all rays from one eye, in the real type that traces them. A ray is inside of what it leaves
/// before it enters it. What a ray meets up to t_min does not count (see formulas::resolution), so an eye
/// that lies on a surface by all that rounding can tell is inside for the rays that go in, and outside for
/// those that go out.
template <class Real>
class DielectricsAroundEye {
 public:
  /// The scene must outlive it. The direction is the one that the camera looks in.
  DielectricsAroundEye(const Scene& scene, const Vec3<Real>& eye, const Vec3<Real>& direction);
  ~DielectricsAroundEye();
  DielectricsAroundEye(DielectricsAroundEye&&) noexcept;

  /// Of the ray that the camera looks along; of every ray, unless the eye lies on a surface.
  const std::vector<EnclosingDielectric>& ahead() const { return ahead_; }
  bool is_on_surface() const { return search_ != nullptr; }
  /// Up to where what a ray from the eye meets cannot be told from the eye, by the glass that it lies on; 0
  /// when it lies on none.
  Real t_min() const;
  /// Outermost first; the direction is a unit vector.
  std::vector<EnclosingDielectric> of_ray(const Vec3<Real>& direction) const;

 private:
  class Search;

  std::unique_ptr<Search> search_;  ///< when each ray has to be asked
  std::vector<EnclosingDielectric> ahead_;
};

}  // namespace plumb
