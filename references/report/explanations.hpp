// The rays of pixels that a reader of a report will ask about.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "references/gates/verify.hpp"

namespace plumb::report {

/// By x and y, the rays of pixels that are over, as explain_text has them: of 300 at most, and 4 MB of text.
/// Empty where the result has no pictures, or somebody else's renderer made them.
std::map<std::pair<int, int>, std::string> explanations_of(const gates::SceneResult& result);

}  // namespace plumb::report
