// A row of the atlas as JSON, as it is kept and told.
#pragma once

#include <nlohmann/json.hpp>

#include "references/studies/stability/atlas.hpp"

namespace plumb::studies::stability {

/// {method, real, source, status, measures, breaks, cause, remedy, curve, wrong}: status is "measured" or
/// "renderer unavailable".
nlohmann::ordered_json json_of(const Row& row);

}  // namespace plumb::studies::stability
