#include "references/cli/render_statistics.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "references/system/json.hpp"

namespace plumb::cli {
namespace {

using Counts = std::vector<std::pair<const char*, std::uint64_t>>;

Counts rays_of(const engine::Statistics& counts) {
  return {{"camera", counts.camera_rays},
          {"shadow", counts.shadow_rays},
          {"mirrored", counts.mirrored_rays},
          {"refracted", counts.refracted_rays}};
}

std::string milliseconds(const engine::Seconds& seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f ms, %.1f ms of CPU", 1e3 * seconds.wall, 1e3 * seconds.cpu);
  return text;
}

double per_object(const engine::Statistics& counts) {
  return counts.objects == 0 ? 0 : static_cast<double>(counts.bytes) / static_cast<double>(counts.objects);
}

nlohmann::ordered_json candidate_json(const references::Candidate& c) {
  nlohmann::ordered_json json{{"real", references::to_string(c.real)},
                              {"depth", c.depth},
                              {"error", c.error.largest()},
                              {"error_against_oracle", c.error.against_oracle},
                              {"error_against_double", nullptr},
                              {"cpu_seconds", c.cpu_seconds}};
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
  for (const references::Candidate& c : chosen.tried) json["tried"].push_back(candidate_json(c));
  return json;
}

}  // namespace

std::string as_text(const RenderStatistics& s) {
  char bytes[96];
  std::snprintf(bytes, sizeof bytes, "%zu objects, %zu bytes, %.0f an object", s.counts.objects,
                s.counts.bytes, per_object(s.counts));
  std::string text = "kernel   " + s.counts.kernel + "\n";
  text += "reading  " + milliseconds(s.read) + "\n";
  if (s.has_counts) text += "building " + milliseconds(s.counts.build) + "; " + bytes + "\n";
  text += "render   " + milliseconds(s.counts.render) + "\n";
  text += "writing  " + milliseconds(s.write) + "\n";
  if (!s.has_counts) return text;
  text += "rays    ";
  for (const auto& [kind, count] : rays_of(s.counts))
    text += std::string(" ") + kind + " " + std::to_string(count);
  return text + "; in " + std::to_string(s.counts.bundles) + " bundles, through " +
         std::to_string(s.counts.nodes) + " nodes, " + std::to_string(s.counts.shape_tests) +
         " tests of a vector against a shape\n";
}

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
  if (!s.has_counts) return references::json_text(json, 2) + "\n";
  json["bytes"] = s.counts.bytes;
  json["objects"] = s.counts.objects;
  for (const auto& [kind, count] : rays_of(s.counts)) json["rays"][kind] = count;
  json["bundles"] = s.counts.bundles;
  json["nodes"] = s.counts.nodes;
  json["shape_tests"] = s.counts.shape_tests;
  return references::json_text(json, 2) + "\n";
}

}  // namespace plumb::cli
