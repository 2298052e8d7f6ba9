#include <nlohmann/json.hpp>

#include "references/report/atlas.hpp"
#include "references/studies/stability/row_json.hpp"

namespace plumb::report {

nlohmann::ordered_json to_json(const std::vector<studies::stability::Condition>& conditions) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const studies::stability::Condition& condition : conditions) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const studies::stability::Row& row : condition.rows)
      rows.push_back(studies::stability::json_of(row));
    list.push_back({{"name", condition.name}, {"unit", condition.unit}, {"rows", std::move(rows)}});
  }
  return {{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"conditions", std::move(list)}};
}

}  // namespace plumb::report
