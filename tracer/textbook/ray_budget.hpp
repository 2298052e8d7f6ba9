// What may be spent on tracing single pixels, and what a ray costs.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "tracer/formulas/quad.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/observer.hpp"

namespace plumb::textbook {

/// What may be spent on tracing; counted and not timed, so that every machine comes to the same result. A
/// unit is a ray in double, or a shadow ray, against one sphere or box: 20 to 40 ns on a machine of 2023.
class Work {
 public:
  explicit Work(double most) : most_(most) {}

  void spend(double units) { spent_ += units; }
  bool is_over() const { return spent_ > most_; }
  double spent() const { return spent_; }
  double left() const { return most_ - spent_; }

 private:
  double most_;
  double spent_ = 0;
};

/// What a number costs beside a double.
template <class Real>
inline constexpr double units_of_real = std::is_same_v<Real, Quad> ? 30 : 1;  // libgcc computes a Quad

/// What a ray costs, be it to a light: shading it, and every sphere and box that it is held against.
template <class Real>
double units_of_ray(InstanceId instances) {
  constexpr double units_of_shading = 20;
  return units_of_real<Real> * (units_of_shading + static_cast<double>(instances));
}

/// What a scene costs that is made ready to be traced.
template <class Real>
double units_of_world(const Scene& scene) {
  constexpr double units_of_shape = 50;
  return units_of_real<Real> * units_of_shape * static_cast<double>(scene.shapes.size());
}

/// No pixel is traced with more rays, in the order in which they follow each other: mirrors that transmit
/// double them with each level of the recursion. The tree of depth 8, the lecture's, has 511 at most.
inline constexpr std::size_t most_rays_of_pixel = 3000;

/// Ends a pixel that has too many rays, and charges each ray that is traced, and each ray to a light that
/// lights its point. Copies count the same pixel.
template <class Real>
class RayBudget : public NoObserver<Real> {
 public:
  /// Of a world with so many instances. `work` must outlive it.
  RayBudget(InstanceId instances, Work& work)
      : units_of_ray_(units_of_ray<Real>(instances)), work_(&work), rays_(std::make_shared<std::size_t>(0)) {}

  bool ray_begins(RayKind, const Ray<Real>&, int /*depth*/) const {
    if (++*rays_ > most_rays_of_pixel) return false;
    work_->spend(units_of_ray_);
    return true;
  }
  void is_lit_by(std::size_t /*light*/, const LightSeen<Real>& seen) const {
    if (seen.counts) work_->spend(units_of_ray_);
  }
  /// Whether the pixel was ended since the last call. The next ray is of another pixel.
  bool take_is_cut() const { return std::exchange(*rays_, 0) > most_rays_of_pixel; }

 private:
  double units_of_ray_;
  Work* work_;
  std::shared_ptr<std::size_t> rays_;  // of the pixel
};

}  // namespace plumb::textbook
