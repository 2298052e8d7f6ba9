#include "references/studies/stability/row_json.hpp"

#include <cmath>

namespace plumb::studies::stability {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json json_of(const std::vector<std::pair<double, double>>& pairs) {
  Json all = Json::array();
  for (const auto& [value, y] : pairs) all.push_back({Json(value), std::isnan(y) ? Json() : Json(y)});
  return all;
}

}  // namespace

Json json_of(const Row& row) {
  const Breaks& b = row.breaks;
  return {{"method", row.method},
          {"real", row.real},
          {"source", row.source},
          {"status", row.unavailable.empty() ? "measured" : "renderer unavailable"},
          {"measures", row.measures},
          {"breaks",
           {{"missed", json_of(b.missed)},
            {"ulp16", json_of(b.ulp16)},
            {"e6", json_of(b.e6)},
            {"percent", json_of(b.percent)},
            {"self_shadow", json_of(b.self_shadow)}}},
          {"cause", row.unavailable.empty() ? row.cause : row.unavailable},
          {"remedy", row.remedy},
          {"curve", json_of(row.curve)},
          {"wrong", json_of(row.wrong)}};
}

}  // namespace plumb::studies::stability
