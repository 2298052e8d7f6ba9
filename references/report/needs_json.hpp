// What a scene needs, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "references/report/needs_report.hpp"

namespace plumb::report {

/// One object, see plumb needs --help.
nlohmann::ordered_json to_json(const NeedsReport& report);

}  // namespace plumb::report
