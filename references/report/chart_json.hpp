// A chart as JSON, for plots and for programs.
#pragma once

#include <nlohmann/json.hpp>

#include "references/studies/chart/chart.hpp"

namespace plumb::report {

/// {plumb, machine, povray, size, runs, truths, cost, instructions_complaint, scenes: [{scene, left_out,
/// points}]}.
nlohmann::ordered_json to_json(const studies::Chart& chart);

}  // namespace plumb::report
