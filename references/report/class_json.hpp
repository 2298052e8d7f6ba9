// A class of tracers as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "references/report/class_report.hpp"

namespace plumb::report {

nlohmann::ordered_json overview_json(const std::vector<submissions::JudgedPicture>& all, HintLevel hint,
                                     const RunFacts& facts = {});

}  // namespace plumb::report
