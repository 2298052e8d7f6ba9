// The atlas of failures as JSON, as a table and as a page.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "references/studies/stability/atlas.hpp"

namespace plumb::report {

/// {conditions: [{name, unit, rows: [{method, real, source, status, measures, breaks, cause, remedy, curve,
/// wrong}]}]}: status is "measured" or "renderer unavailable"; measures is "t" (a ray is wrong that misses,
/// meets itself or is 1 % off) or "pixels" (over 1e-6).
nlohmann::ordered_json to_json(const std::vector<studies::stability::Condition>& conditions);

/// A table for a terminal.
std::string table_of(const std::vector<studies::stability::Condition>& conditions);

/// A page that needs no network: a map a condition, methods down, the condition across.
std::string page_of(const std::vector<studies::stability::Condition>& conditions);

/// A value at which something breaks; a dash when it does not.
std::string value_text(const std::optional<double>& value);

}  // namespace plumb::report
