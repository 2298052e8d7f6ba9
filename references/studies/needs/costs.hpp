// Measures what features of a scene cost: CPU time with them and without.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "references/studies/needs/untouched.hpp"
#include "tracer/scene/render_job.hpp"

namespace plumb::studies {

struct FeatureCost {
  std::string feature;
  double ratio = 1;                ///< CPU time with it over that without: the median of the rounds
  double least = 1, greatest = 1;  ///< of the rounds
};

struct Costs {
  double cpu_seconds = 0;  ///< median CPU time of the picture with all features
  int rounds = 0;
  std::vector<FeatureCost> costs;
};

/// Renders the picture on one thread of the engine with all features, then without each that it has, and so
/// on in rounds. So what disturbs the machine disturbs both sides of a ratio.
Costs measure_costs(const Scene& scene, const Camera& camera, const RenderJob& job,
                    const Untouched& untouched);

}  // namespace plumb::studies
