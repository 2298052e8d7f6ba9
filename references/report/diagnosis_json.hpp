// A diagnosis as JSON, the same wherever it is written.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "references/diagnosis/case.hpp"
#include "references/diagnosis/diagnosis.hpp"

namespace plumb::report {

/// {verdict, faults: [{slide, confidence, pixels, title, id, catalogue, wrong, right}], explains: all or
/// part, unexplained_pixels, edge_pixels, non_finite, pixels, shapes: [{name, pixels}], ambiguous: [[id,
/// id]], encoding: {tone_map, gamma, rounding, levels, flipped}, remaining: {rms, pixels_over_2_255}}.
/// `explains` is there with faults, `pixels` and `shapes` with right_apart. `hint` says how much is told of a
/// fault: 1 its slide, 2 its title, too, 3 all. `flipped` is told from 2 on, `ambiguous` at 3.
nlohmann::ordered_json to_json(const diagnosis::Diagnosis& diagnosis, int hint);

/// {id, catalogue, title, slide}, then what is known of it `here`, then {value, wrong, right}, as far as the
/// hint tells them.
nlohmann::ordered_json fault_json(const faults::Fault& fault, int hint, const nlohmann::ordered_json& here);

/// Their ids.
nlohmann::ordered_json ids_json(const std::vector<const faults::Fault*>& faults);

/// {faults: [{slide, confidence, pictures, title, id, catalogue, wrong, right, alike}], certain, withdrawn:
/// [{id, picture, contradicted_by}]}, with `names` of the pictures. `withdrawn` is told at hint 3.
nlohmann::ordered_json to_json(const diagnosis::CaseDiagnosis& joined, const std::vector<std::string>& names,
                               int hint);

/// {camera, shadows, shading}, each right, wrong or null.
nlohmann::ordered_json to_json(const diagnosis::Certain& certain);

}  // namespace plumb::report
