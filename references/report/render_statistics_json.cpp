#include "references/report/render_statistics_json.hpp"

#include <nlohmann/json.hpp>

#include "references/system/json.hpp"

namespace plumb::report {
namespace {

nlohmann::ordered_json candidate_json(const studies::Candidate& c) {
  nlohmann::ordered_json json{
      {"real", studies::to_string(c.real)}, {"depth", c.depth},
      {"error", c.error.largest()},         {"error_against_oracle", c.error.against_oracle},
      {"error_against_double", nullptr},    {"cpu_seconds", c.cpu_seconds}};
  if (c.error.against_double) json["error_against_double"] = *c.error.against_double;
  return json;
}

nlohmann::ordered_json chosen_json(const ChosenForError& chosen) {
  nlohmann::ordered_json json{{"asked", chosen.bound},
                              {"asked_depth", chosen.asked_depth},
                              {"oracle_pixels", chosen.oracle_pixels},
                              {"pixels", chosen.pixels},
                              {"chosen", candidate_json(chosen.candidate)},
                              {"reason", chosen.reason}};
  for (const studies::Candidate& c : chosen.tried) json["tried"].push_back(candidate_json(c));
  return json;
}

}  // namespace

std::string as_json(const RenderStatistics& s) {
  nlohmann::ordered_json json{{"scene", s.scene}, {"engine", s.engine}, {"real", s.real},
                              {"width", s.width}, {"height", s.height}, {"kernel", s.counts.kernel}};
  for (const auto& [name, seconds] : {std::pair{"read", s.read},
                                      {"build", s.counts.build},
                                      {"render", s.counts.render},
                                      {"write", s.write}}) {
    json["seconds"][name] = seconds.wall;
    json["cpu_seconds"][name] = seconds.cpu;
  }
  if (s.chosen) json["error"] = chosen_json(*s.chosen);
  if (!s.has_counts) return system::json_text(json, 2) + "\n";
  json["bytes"] = s.counts.bytes;
  json["objects"] = s.counts.objects;
  for (const auto& [kind, count] : rays_of(s.counts)) json["rays"][kind] = count;
  json["bundles"] = s.counts.bundles;
  json["nodes"] = s.counts.nodes;
  json["shape_tests"] = s.counts.shape_tests;
  return system::json_text(json, 2) + "\n";
}

}  // namespace plumb::report
