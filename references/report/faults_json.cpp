#include "references/report/faults_json.hpp"

#include "references/teaching/document.hpp"

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;

Json fault_json(const faults::Fault& fault) {
  return {{"id", fault.id},
          {"catalogue", fault.catalogue},
          {"slide", fault.slide},
          {"title", fault.explanation},
          {"wrong", fault.wrong},
          {"right", fault.right},
          {"how_common", fault.how_common},
          {"scene", fault.shown_by}};
}

}  // namespace

Json faults_json() {
  Json all = Json::array();
  for (const faults::Fault& fault : faults::fault_catalogue()) all.push_back(fault_json(fault));
  return {{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"faults", all}};
}

Json corpus_json(const teaching::Matrix& matrix, const teaching::TeachingSet& set) {
  Json scenes = Json::array();
  for (const std::size_t scene : set.scenes) scenes.push_back(matrix.scenes()[scene]);
  Json left = Json::array();
  for (const teaching::Pair& pair : set.left)
    left.push_back({teaching::picture_name(pair.a), teaching::picture_name(pair.b)});
  Json seen = Json::object();
  for (std::size_t fault = 0; fault < faults::fault_catalogue().size(); ++fault) {
    Json in = Json::array();
    for (std::size_t i = 0; i < matrix.scenes().size(); ++i) {
      if (matrix.shows(i, fault)) in.push_back(matrix.scenes()[i]);
    }
    seen[std::string(faults::fault_catalogue()[fault].id)] = in;
  }
  return {{"scenes", matrix.scenes()},
          {"teaching_set", scenes},
          {"is_proven", set.is_proven},
          {"not_told_apart", left},
          {"seen_in", seen}};
}

}  // namespace plumb::report
