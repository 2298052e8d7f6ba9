#include "references/studies/chart/measurement.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "references/system/json.hpp"
#include "tracer/system/files.hpp"

namespace plumb::studies {
namespace {

using Json = nlohmann::json;

MeasuredRun run_of(const Json& json) {
  MeasuredRun run{{json.at("cpu_seconds"), std::nullopt}, json.at("yardstick_seconds")};
  if (!json.at("instructions").is_null()) run.cost.instructions = json.at("instructions");
  return run;
}

Json json_of(const MeasuredRun& run) {
  Json json{{"cpu_seconds", run.cost.cpu_seconds},
            {"yardstick_seconds", run.yardstick_seconds},
            {"instructions", nullptr}};
  if (run.cost.instructions) json["instructions"] = *run.cost.instructions;
  return json;
}

}  // namespace

double Measurement::seconds() const {
  double sum = 0;
  for (const MeasuredRun& run : runs) sum += run.cost.cpu_seconds;
  return sum;
}

Measurement load_measurement(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return {};
  try {
    const Json json = system::parse_json(read_file(path));
    Measurement measurement;
    const Json& error = json.at("error");
    measurement.error = {error.at("max"), error.at("rms"), error.at("pixels_over"), error.at("non_finite")};
    for (const Json& run : json.at("runs")) measurement.runs.push_back(run_of(run));
    return measurement;
  } catch (const Json::exception&) {
    return {};  // damaged is as good as absent
  }
}

void store_measurement(const std::string& path, const Measurement& measurement) {
  const ChartError& error = measurement.error.value();
  Json json{{"error",
             {{"max", error.max},
              {"rms", error.rms},
              {"pixels_over", error.pixels_over},
              {"non_finite", error.non_finite}}},
            {"runs", Json::array()}};
  for (const MeasuredRun& run : measurement.runs) json["runs"].push_back(json_of(run));
  write_file(path, system::json_text(json) + "\n");
}

}  // namespace plumb::studies
