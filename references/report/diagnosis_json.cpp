#include "references/report/diagnosis_json.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const diagnosis::FoundFault& found, int hint) {
  return fault_json(
      *found.fault, hint,
      {{"confidence", found.confidence},
       {"pixels", found.pixels},
       {"evidence", {{"pixels", std::max(found.changed, found.pixels)}, {"only_it", found.pixels}}}});
}

/// The background's name is null.
Json shapes_json(const std::vector<diagnosis::ShapeSeen>& shapes) {
  Json all = Json::array();
  for (const diagnosis::ShapeSeen& shape : shapes)
    all.push_back({{"name", shape.name.empty() ? Json() : Json(shape.name)}, {"pixels", shape.pixels}});
  return all;
}

Json habits_json(const std::vector<diagnosis::Habit>& habits) {
  Json all = Json::array();
  for (const diagnosis::Habit& habit : habits) {
    all.push_back(
        {{"id", habit.id}, {"title", habit.title}, {"value", {habit.value.r, habit.value.g, habit.value.b}}});
  }
  return all;
}

/// Null where the picture does not tell.
Json certain_json(diagnosis::Certainty certainty) {
  switch (certainty) {
    case diagnosis::Certainty::right:
      return "right";
    case diagnosis::Certainty::wrong:
      return "wrong";
    case diagnosis::Certainty::unknown:
      break;
  }
  return {};
}

/// Levels of red, green and blue; null for floats.
Json levels_json(const diagnosis::OutputEncoding& encoding) {
  return encoding.is_float ? Json() : Json(encoding.levels);
}

/// Null for floats, which are not rounded.
Json rounding_json(const diagnosis::OutputEncoding& encoding) {
  return encoding.is_float ? Json() : Json(encoding.rounds ? "round" : "truncate");
}

Json to_json(const diagnosis::CaseFault& found, const std::vector<std::string>& names, int hint) {
  Json pictures = Json::array();
  for (const std::size_t i : found.pictures) pictures.push_back(names[i]);
  Json json = fault_json(*found.fault, hint, {{"confidence", found.confidence}, {"pictures", pictures}});
  if (hint >= 3) json["alike"] = ids_json(found.alike);
  return json;
}

}  // namespace

Json fault_json(const faults::Fault& fault, int hint, const Json& here) {
  Json json;
  if (hint >= 3) json = {{"id", fault.id}, {"catalogue", fault.catalogue}};
  if (hint >= 2) json["title"] = fault.explanation;
  json["slide"] = fault.slide;
  json.update(here);
  if (hint < 3) return json;
  if (!std::isnan(fault.value)) json["value"] = fault.value;
  json["wrong"] = fault.wrong;
  json["right"] = fault.right;
  return json;
}

Json ids_json(const std::vector<const faults::Fault*>& faults) {
  Json ids = Json::array();
  for (const faults::Fault* fault : faults) ids.push_back(fault->id);
  return ids;
}

Json to_json(const diagnosis::CaseDiagnosis& joined, const std::vector<std::string>& names, int hint) {
  Json faults = Json::array(), withdrawn = Json::array();
  for (const diagnosis::CaseFault& found : joined.faults) faults.push_back(to_json(found, names, hint));
  for (const auto& [fault, picture, by] : joined.withdrawn)
    withdrawn.push_back({{"id", fault->id}, {"picture", names[picture]}, {"contradicted_by", names[by]}});
  Json json{{"faults", faults}, {"certain", to_json(joined.certain)}};
  if (hint >= 3) json["withdrawn"] = withdrawn;
  return json;
}

Json to_json(const diagnosis::Certain& certain) {
  return {{"camera", certain_json(certain.camera)},
          {"shadows", certain_json(certain.shadows)},
          {"shading", certain_json(certain.shading)}};
}

Json to_json(const diagnosis::Diagnosis& diagnosis, int hint) {
  Json faults = Json::array();
  Json ambiguous = Json::array();
  for (const diagnosis::FoundFault& found : diagnosis.faults) {
    faults.push_back(to_json(found, hint));
    for (const faults::Fault* other : found.alike) ambiguous.push_back({found.fault->id, other->id});
  }
  Json json{{"verdict", diagnosis::to_string(diagnosis.verdict)}, {"faults", faults}};
  if (!diagnosis.faults.empty()) json["explains"] = diagnosis.explains_all() ? "all" : "part";
  json["certain"] = to_json(diagnosis.certain);
  json["habits"] = habits_json(diagnosis.habits);
  json["unexplained_pixels"] = diagnosis.unexplained_pixels;
  json["edge_pixels"] = diagnosis.edges;
  json["non_finite"] = diagnosis.non_finite;
  if (diagnosis.verdict == diagnosis::PictureVerdict::right_apart) {
    json["pixels"] = diagnosis.unexplained_pixels;
    json["shapes"] = shapes_json(diagnosis.shapes);
  }
  if (hint >= 3) json["ambiguous"] = ambiguous;
  json["encoding"] = {{"tone_map", diagnosis.encoding.tone_map},
                      {"gamma", diagnosis.encoding.gamma()},
                      {"rounding", rounding_json(diagnosis.encoding)},
                      {"levels", levels_json(diagnosis.encoding)}};
  if (hint >= 2) json["encoding"]["flipped"] = diagnosis.is_flipped;  // which names a mistake
  json["remaining"] = {{"rms", diagnosis.rms},
                       {"pixels_over_2_255", diagnosis.pixels_over},
                       {"by_object", shapes_json(diagnosis.shapes)}};
  return json;
}

}  // namespace plumb::report
