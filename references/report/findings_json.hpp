// Two image files that were compared, as JSON.
#pragma once

#include "references/gates/findings.hpp"
#include "references/report/results_json.hpp"

namespace plumb::report {

/// tool, version, reference, test, status, tolerance, size, the figures, what was compared, and where there
/// are such: bounds, likely_cause, metrics, no_metrics.
Json json_of(const gates::Findings& findings);

}  // namespace plumb::report
