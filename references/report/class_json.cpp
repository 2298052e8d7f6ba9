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

/// What the pictures of each submission say together.
Json submissions_json(const std::vector<submissions::JudgedPicture>& all, HintLevel hint) {
  Json joined = Json::array();
  for (std::size_t first = 0; first < all.size();) {
    std::vector<const diagnosis::Diagnosis*> told;
    std::vector<std::string> scenes;
    std::size_t next = first;
    for (; next < all.size() && all[next].submission == all[first].submission; ++next) {
      told.push_back(all[next].diagnosis ? &*all[next].diagnosis : nullptr);
      scenes.push_back(all[next].scene);
    }
    Json json{{"submission", all[first].submission}};
    json.update(to_json(diagnosis::diagnosis_of_case(told), scenes, hint));
    joined.push_back(std::move(json));
    first = next;
  }
  return joined;
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
  json["submissions"] = submissions_json(all, hint);
  return json;
}

}  // namespace plumb::report
