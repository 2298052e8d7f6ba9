// Traces single pixels of a scene, and counts what that costs.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "references/attribution/attribution.hpp"
#include "references/attribution/ray_tree.hpp"

namespace plumb::references {

/// As pictures hold it.
using Colour = std::array<float, 3>;

/// What may be spent on tracing; counted and not timed, so that every machine comes to the same result. A
/// unit is a ray, or a shadow ray, against one sphere or box: 20 to 40 ns on a machine of 2023.
class Work {
 public:
  explicit Work(double most) : most_(most), left_(most) {}

  void spend(double units) { left_ -= units; }
  bool is_over() const { return left_ < 0; }
  double spent() const { return most_ - left_; }

 private:
  double most_;
  double left_;
};

/// What a ray costs, be it to a light.
double cost_of_ray(textbook::InstanceId instances);

/// Ends a pixel that has too many rays, and counts the work.
class RayLimit : public textbook::NoObserver<double> {
 public:
  /// `work` must outlive it.
  RayLimit(double units_of_ray, Work& work);

  bool ray_begins(textbook::RayKind, const Ray<double>&, int depth) const;
  void is_lit_by(std::size_t light, const textbook::LightSeen<double>& seen) const;
  /// Whether the pixel was ended since the last call.
  bool take_is_cut() const;

 private:
  double units_of_ray_;
  Work* work_;
  std::shared_ptr<std::size_t> rays_;  // of the pixel, counted by all copies
};

/// A scene and what traces single pixels of it, with or without a record of the rays.
class PixelTracer {
 public:
  /// `work` must outlive it; making the world is counted, too.
  PixelTracer(Scene scene, const AttributionJob& job, const RenderOptions& options, Work& work,
              const textbook::FormulaTable<double>& formulas = {});
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;

  /// Nothing when the pixel has too many rays to be traced.
  std::optional<Colour> at(const AttributedPixel& p) const;
  RayNode tree_of(const AttributedPixel& p) const;

 private:
  using Formulas = textbook::ReplaceableFormulas<double>;
  Scene scene_;
  textbook::World<double> world_;
  Work& work_;
  double units_of_ray_;
  RayLimit limit_;
  textbook::Tracer<double, Formulas, RayLimit> tracer_;
  Recorder recorder_;
  textbook::Tracer<double, Formulas, Recorder> recording_;
};

}  // namespace plumb::references
