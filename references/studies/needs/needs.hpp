// What a scene's picture needs, and what that costs.
#pragma once

#include <vector>

#include "references/studies/needs/choice.hpp"
#include "references/studies/needs/costs.hpp"
#include "references/studies/needs/features.hpp"
#include "references/studies/needs/observed.hpp"
#include "references/studies/needs/untouched.hpp"

namespace plumb::references {

/// How far a picture of less depth is from the one asked for.
struct DepthStep {
  int depth;
  double error;
};

struct DepthNeed {
  int asked = 0;
  std::vector<DepthStep> steps;  ///< those that were rendered, in double, the shallowest first
  int same_from = 0;  ///< a depth whose picture is the asked one's, bit for bit, and that before is not
  int within_bound_from = 0;  ///< likewise, its error at most the bound
  /// When rays are black at the depth asked for: how far the picture of the next depth is off. Else 0.
  double change_beyond = 0;
};

struct Needs {
  Observed observed;
  std::vector<Feature> features;
  Untouched untouched;
  bool is_same_without_untouched = true;  ///< the picture in double, bit for bit
  Candidate in_float, in_double;          ///< at the depth asked for
  std::size_t oracle_pixels = 0;
  DepthNeed depth;
  Costs costs;
};

/// Looks, renders and measures; throws what rendering does.
Needs needs_of(const Scene& scene, const Camera& camera, const RenderJob& job, double bound);

/// The real type that suffices for an error bound by these figures: "float", "double", or "neither".
std::string sufficient_real(const Needs& needs, double bound);

}  // namespace plumb::references
