// What a report concludes, in a sentence for each result and one for all.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace plumb::report {

/// Of one result, as ReportEntry has it.
std::string conclusion_of(const nlohmann::ordered_json& result);

/// Of all entries of a report: an array of objects that hold "result" and "conclusion".
std::string conclusion_of_all(const nlohmann::ordered_json& entries);

}  // namespace plumb::report
