#include "references/report/class_json.hpp"

#include <map>

#include "references/report/diagnosis_json.hpp"

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;

Json picture_json(const submissions::JudgedPicture& picture, HintLevel hint) {
  Json json{{"submission", picture.submission},
            {"scene", picture.scene},
            {"verdict", submissions::to_string(picture.verdict)},
            {"message", picture.message},
            {"wall_seconds", picture.wall_seconds}};
  if (!picture.printed.empty()) json["printed"] = picture.printed;
  if (!picture.diagnosis) return json;
  Json diagnosis = to_json(*picture.diagnosis, hint);
  diagnosis.erase("verdict");
  json.update(diagnosis);
  return json;
}

}  // namespace

Json overview_json(const std::vector<submissions::JudgedPicture>& all, HintLevel hint,
                   const RunFacts& facts) {
  std::map<std::string, std::size_t> counts;
  Json pictures = Json::array();
  for (const submissions::JudgedPicture& picture : all) {
    ++counts[submissions::to_string(picture.verdict)];
    pictures.push_back(picture_json(picture, hint));
  }
  Json json{{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"complete", judged_count(all) == all.size()}};
  if (facts.seed) json["shuffle"] = {{"seed", *facts.seed}, {"unvaried", facts.unvaried}};
  if (!facts.not_enforced.empty()) json["limits_not_enforced"] = facts.not_enforced;
  if (!facts.of_no_scene.empty()) json["of_no_scene"] = facts.of_no_scene;
  json["verdicts"] = counts;
  json["pictures"] = pictures;
  return json;
}

}  // namespace plumb::report
