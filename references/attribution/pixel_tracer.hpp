// Traces single pixels of a scene, and counts what that costs.
#pragma once

#include <array>
#include <optional>

#include "references/attribution/attribution.hpp"
#include "references/attribution/perturbed_formulas.hpp"
#include "references/attribution/ray_tree.hpp"

namespace plumb::attribution {

/// A colour as pictures hold it.
using Colour = std::array<float, 3>;

/// A scene and what traces single pixels of it, with or without a record of the rays.
class PixelTracer {
 public:
  /// `work` must outlive it; making the world is counted, too.
  PixelTracer(Scene scene, const AttributionJob& job, const RenderOptions& options, textbook::Work& work,
              const PerturbedFormulas& formulas = {});
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;

  /// Nothing when the pixel has too many rays to be traced.
  std::optional<Colour> at(const AttributedPixel& p) const;
  /// Of the same rays.
  RayNode tree_of(const AttributedPixel& p) const;

 private:
  Scene scene_;
  textbook::World<double, PerturbedFormulas> world_;
  textbook::RayBudget<double> budget_;
  textbook::Tracer<double, PerturbedFormulas, textbook::RayBudget<double>> tracer_;
  Recorder recorder_;
  textbook::Tracer<double, PerturbedFormulas, Recorder> recording_;
};

}  // namespace plumb::attribution
