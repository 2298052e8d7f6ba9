// Finds out what a scene's picture needs, and what that costs.
#pragma once

#include <vector>

#include "references/studies/needs/choice.hpp"
#include "references/studies/needs/costs.hpp"
#include "references/studies/needs/features.hpp"
#include "references/studies/needs/observed.hpp"
#include "references/studies/needs/untouched.hpp"

namespace plumb::studies {

/// How far a picture of less depth is from the one asked for.
struct DepthStep {
  int depth;
  double error;
};

struct DepthNeed {
  int asked = 0;
  std::vector<DepthStep> steps;  ///< those that were rendered, in double, the shallowest first
  int same_from = 0;             ///< least depth known to give the asked picture bit for bit
  int within_bound_from = 0;     ///< least depth known to have an error of at most the bound
  /// How far the picture of the next depth is off, if rays are black at the depth asked for. Else 0.
  double change_beyond = 0;
};

struct Needs {
  Observed observed;
  std::vector<Feature> features;
  Untouched untouched;
  bool is_same_without_untouched = true;  ///< of the picture in double, bit for bit
  Candidate in_float, in_double;          ///< at the depth asked for
  std::size_t oracle_pixels = 0;
  DepthNeed depth;
  Costs costs;
};

/// Observes, renders and measures. Throws what rendering throws.
Needs needs_of(const Scene& scene, const Camera& camera, const RenderJob& job, double bound);

/// Returns the real type that suffices for an error bound by these figures: "float", "double", or "neither".
std::string sufficient_real(const Needs& needs, double bound);

}  // namespace plumb::studies
