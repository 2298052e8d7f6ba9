#include "references/submissions/record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace plumb::submissions {
namespace {

using Json = nlohmann::ordered_json;

/// The id, of a family's member with its constant.
std::string name_of(const faults::Fault& fault) {
  const std::string id(fault.id);
  return std::isnan(fault.value) ? id : id + " " + std::to_string(fault.value);
}

const faults::Fault* fault_of(const Json& id) {
  const std::string name = id.get<std::string>();
  for (const auto* list :
       {&faults::fault_catalogue(), &faults::geometry_families(), &faults::shading_families()}) {
    const auto found = std::find_if(list->begin(), list->end(),
                                    [&](const faults::Fault& fault) { return name_of(fault) == name; });
    if (found != list->end()) return &*found;
  }
  throw std::runtime_error("an unknown fault");
}

/// JSON has no NaN: null stands for it.
double real_of(const Json& number) {
  return number.is_null() ? std::numeric_limits<double>::quiet_NaN() : number.get<double>();
}

Json record_of(const diagnosis::FoundFault& found) {
  Json alike = Json::array();
  for (const faults::Fault* fault : found.alike) alike.push_back(name_of(*fault));
  return {{"id", name_of(*found.fault)},
          {"confidence", found.confidence},
          {"pixels", found.pixels},
          {"alike", alike},
          {"changed", found.changed}};
}

diagnosis::FoundFault found_of(const Json& json) {
  diagnosis::FoundFault found{
      fault_of(json.at("id")), real_of(json.at("confidence")), json.at("pixels"), {}, json.at("changed")};
  for (const Json& id : json.at("alike")) found.alike.push_back(fault_of(id));
  return found;
}

Json record_of(const diagnosis::OutputEncoding& encoding) {
  return {{"tone_map", encoding.tone_map},
          {"curve", static_cast<int>(encoding.curve)},
          {"rounds", encoding.rounds},
          {"is_float", encoding.is_float},
          {"has_equal_parts", encoding.has_equal_parts},
          {"has_upper_bits", encoding.has_upper_bits},
          {"reduced", static_cast<int>(encoding.reduced)},
          {"levels", encoding.levels},
          {"lost", encoding.lost},
          {"shares_exponent", encoding.shares_exponent}};
}

diagnosis::OutputEncoding encoding_of(const Json& json) {
  diagnosis::OutputEncoding encoding;
  encoding.tone_map = json.at("tone_map");
  encoding.curve = static_cast<diagnosis::Curve>(json.at("curve").get<int>());
  encoding.rounds = json.at("rounds");
  encoding.is_float = json.at("is_float");
  encoding.has_equal_parts = json.at("has_equal_parts");
  encoding.has_upper_bits = json.at("has_upper_bits").get<std::array<bool, 3>>();
  encoding.reduced = static_cast<diagnosis::Reduced>(json.at("reduced").get<int>());
  encoding.levels = json.at("levels").get<std::array<int, 3>>();
  encoding.lost = json.at("lost");
  encoding.shares_exponent = json.at("shares_exponent");
  return encoding;
}

Json record_of(const diagnosis::ShapeSeen& shape) { return {shape.name, shape.pixels}; }

Json record_of(const diagnosis::Habit& habit) {
  return {habit.id, habit.title, habit.value.r, habit.value.g, habit.value.b};
}

diagnosis::Habit habit_of(const Json& json) {
  return {json.at(0), json.at(1), Rgbd(json.at(2), json.at(3), json.at(4))};
}

Json record_of(const diagnosis::Diagnosis& diagnosis) {
  Json habits = Json::array();
  for (const diagnosis::Habit& habit : diagnosis.habits) habits.push_back(record_of(habit));
  Json faults = Json::array();
  for (const diagnosis::FoundFault& found : diagnosis.faults) faults.push_back(record_of(found));
  Json excluded = Json::array();
  for (const faults::Fault* fault : diagnosis.excluded) excluded.push_back(name_of(*fault));
  Json shapes = Json::array();
  for (const diagnosis::ShapeSeen& shape : diagnosis.shapes) shapes.push_back(record_of(shape));
  return {{"verdict", static_cast<int>(diagnosis.verdict)},
          {"faults", faults},
          {"encoding", record_of(diagnosis.encoding)},
          {"is_flipped", diagnosis.is_flipped},
          {"rms", diagnosis.rms},
          {"pixels_over", diagnosis.pixels_over},
          {"pixels", diagnosis.pixels},
          {"non_finite", diagnosis.non_finite},
          {"edges", diagnosis.edges},
          {"unexplained_pixels", diagnosis.unexplained_pixels},
          {"is_of_one_colour", diagnosis.is_of_one_colour},
          {"habits", habits},
          {"camera", static_cast<int>(diagnosis.certain.camera)},
          {"shadows", static_cast<int>(diagnosis.certain.shadows)},
          {"shading", static_cast<int>(diagnosis.certain.shading)},
          {"shapes", shapes},
          {"excluded", excluded}};
}

diagnosis::Diagnosis diagnosis_of(const Json& json) {
  diagnosis::Diagnosis diagnosis;
  diagnosis.verdict = static_cast<diagnosis::PictureVerdict>(json.at("verdict").get<int>());
  for (const Json& found : json.at("faults")) diagnosis.faults.push_back(found_of(found));
  diagnosis.encoding = encoding_of(json.at("encoding"));
  diagnosis.is_flipped = json.at("is_flipped");
  diagnosis.rms = real_of(json.at("rms"));
  diagnosis.pixels_over = json.at("pixels_over");
  diagnosis.pixels = json.at("pixels");
  diagnosis.non_finite = json.at("non_finite");
  diagnosis.edges = json.at("edges");
  diagnosis.unexplained_pixels = json.at("unexplained_pixels");
  diagnosis.is_of_one_colour = json.at("is_of_one_colour");
  for (const Json& habit : json.at("habits")) diagnosis.habits.push_back(habit_of(habit));
  diagnosis.certain.camera = static_cast<diagnosis::Certainty>(json.at("camera").get<int>());
  diagnosis.certain.shadows = static_cast<diagnosis::Certainty>(json.at("shadows").get<int>());
  diagnosis.certain.shading = static_cast<diagnosis::Certainty>(json.at("shading").get<int>());
  for (const Json& shape : json.at("shapes"))
    diagnosis.shapes.push_back({shape.at(0).get<std::string>(), shape.at(1).get<std::size_t>()});
  for (const Json& id : json.at("excluded")) diagnosis.excluded.push_back(fault_of(id));
  return diagnosis;
}

}  // namespace

Json record_of(const JudgedPicture& picture) {
  Json record{{"submission", picture.submission},
              {"scene", picture.scene},
              {"verdict", to_string(picture.verdict)},
              {"message", picture.message},
              {"printed", picture.printed},
              {"wall_seconds", picture.wall_seconds}};
  if (picture.diagnosis) record["diagnosis"] = record_of(*picture.diagnosis);
  return record;
}

JudgedPicture picture_of_record(const Json& record) {
  JudgedPicture picture;
  picture.submission = record.at("submission");
  picture.scene = record.at("scene");
  picture.verdict = verdict_named(record.at("verdict").get<std::string>());
  picture.message = record.at("message");
  picture.printed = record.at("printed");
  picture.wall_seconds = real_of(record.at("wall_seconds"));
  if (record.contains("diagnosis")) picture.diagnosis = diagnosis_of(record["diagnosis"]);
  return picture;
}

}  // namespace plumb::submissions
