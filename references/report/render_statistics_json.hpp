// What a render did, as JSON.
#pragma once

#include <string>

#include "references/report/render_statistics.hpp"

namespace plumb::report {

/// One object, see plumb render --stats-json.
std::string as_json(const RenderStatistics& statistics);

}  // namespace plumb::report
