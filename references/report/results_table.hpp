// Results of verify and regress as lines of a table.
#pragma once

#include <string>
#include <vector>

#include "references/gates/verify.hpp"

namespace plumb::report {

/// Width of the first column that holds these names.
std::size_t name_width(const std::vector<std::string>& scenes);
/// The column "error" is what the tolerance is held against: relative above 1.
std::string table_head(std::size_t name_width);
/// `message` is that of the result, perhaps with more.
std::string table_row(const gates::SceneResult& result, const std::string& message, std::size_t name_width);

/// E.g. "20 scenes: 19 agree, 1 differs".
std::string outcome(const gates::VerifyReport& report);

}  // namespace plumb::report
