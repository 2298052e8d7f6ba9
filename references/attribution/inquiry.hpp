// What the provers of causes share: the two pictures, and tracers of the scene as it is and moved.
#pragma once

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "references/attribution/attribution.hpp"
#include "references/attribution/perturbation.hpp"
#include "references/attribution/pixel_tracer.hpp"

namespace plumb::attribution {

/// Of one budget; a prover sets their causes.
using SuspectPixels = std::vector<AttributedPixel*>;

inline constexpr int no_pattern = -1;  ///< nothing is moved
/// Two surfaces stay in one order in all of them once in 2^47 cases.
inline constexpr int usual_patterns = 48;

class Inquiry {
 public:
  /// The job must outlive it.
  explicit Inquiry(const AttributionJob& job);

  const AttributionJob& job() const { return job_; }
  /// The job's, its instances apart.
  const Scene& scene() const { return scene_; }
  const Perturbation& perturbation() const { return perturbation_; }
  textbook::Work& work() const { return work_; }
  const PixelTracer& still() const { return still_; }

  const float* reference(const AttributedPixel& p) const { return job_.reference.pixel(p.x, p.y); }
  const float* test(const AttributedPixel& p) const { return job_.test.pixel(p.x, p.y); }
  /// On both sides.
  bool is_finite(const AttributedPixel& p) const;

  /// The worlds of the last patterns are kept, for the trees of outcomes that were found before.
  std::shared_ptr<const PixelTracer> moved_by(int pattern) const;
  RayNode tree(int pattern, const AttributedPixel& p) const;

 private:
  const AttributionJob& job_;
  Scene scene_;
  Perturbation perturbation_;
  mutable textbook::Work work_;
  PixelTracer still_;
  mutable std::deque<std::pair<int, std::shared_ptr<const PixelTracer>>> moved_;
};

}  // namespace plumb::attribution
