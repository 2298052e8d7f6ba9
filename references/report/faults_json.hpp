// The catalogue of faults, and which scenes show them, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "references/teaching/cover.hpp"

namespace plumb::report {

/// tool, version, faults: [{id, catalogue, slide, title, wrong, right, how_common, scene}].
nlohmann::ordered_json faults_json();

/// {scenes, teaching_set, is_proven, not_told_apart: [[picture, picture]], seen_in: {fault: [scene]}}.
nlohmann::ordered_json corpus_json(const teaching::Matrix& matrix, const teaching::TeachingSet& set);

}  // namespace plumb::report
