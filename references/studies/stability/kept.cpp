#include "references/studies/stability/kept.hpp"

#include <filesystem>
#include <limits>

#include "references/studies/stability/row_json.hpp"
#include "references/system/digest.hpp"
#include "references/system/json.hpp"
#include "tracer/system/files.hpp"

namespace plumb::studies::stability {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> number(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

std::vector<std::pair<double, double>> pairs(const Json& json) {
  std::vector<std::pair<double, double>> all;
  for (const Json& point : json)
    all.emplace_back(point.at(0).get<double>(),
                     number(point.at(1)).value_or(std::numeric_limits<double>::quiet_NaN()));
  return all;
}

}  // namespace

bool Kept::find(const std::string& condition, const std::string& renderer, Row& row) const {
  const std::string file = path(condition, renderer, row);
  std::error_code error;
  if (directory_.empty() || !std::filesystem::is_regular_file(file, error)) return false;
  try {
    const Json json = system::parse_ordered_json(read_file(file));
    const Json& b = json.at("breaks");
    const Breaks breaks{number(b.at("missed")), number(b.at("ulp16")), number(b.at("e6")),
                        number(b.at("percent")), number(b.at("self_shadow"))};
    row.curve = pairs(json.at("curve"));
    row.wrong = pairs(json.at("wrong"));
    row.breaks = breaks;
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

void Kept::keep(const std::string& condition, const std::string& renderer, const Row& row) const {
  if (directory_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(directory_, error);
  if (error) return;
  write_file(path(condition, renderer, row), system::json_text(json_of(row)));
}

std::string Kept::path(const std::string& condition, const std::string& renderer, const Row& row) const {
  constexpr const char* settings = "rows 13";  // another number when a method or a sweep changes
  return directory_ + "/stability-" +
         system::sha256(std::string(PLUMB_VERSION) + " " + settings + " " + condition + " " + row.method +
                        " " + row.real + " " + renderer + (quick_ ? " quick" : " full")) +
         ".json";
}

}  // namespace plumb::studies::stability
