// A diagnosis as JSON, the same wherever it is written.
#pragma once

#include <nlohmann/json.hpp>

#include "references/diagnosis/diagnosis.hpp"

namespace plumb::references {

/// {verdict, faults: [{slide, confidence, pixels, title, id, catalogue, wrong, right}], ambiguous: [[id,
/// id]], encoding: {tone_map, gamma, rounding, flipped}, remaining: {rms, pixels_over_2_255}}. How much is
/// told of a fault: 1 its slide, 2 its title, too, 3 all; `ambiguous` is told at 3.
nlohmann::ordered_json to_json(const Diagnosis& diagnosis, int hint);

}  // namespace plumb::references
