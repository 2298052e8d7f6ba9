#include "references/report/chart_json.hpp"

#include "references/studies/chart/truth.hpp"

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

const char* name_of(studies::Truth truth) {
  return truth == studies::Truth::pixel_centres ? "pixel_centres" : "pixel_areas";
}

Json json_of(const studies::Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Json json_of(const studies::ChartPoint& point) {
  const studies::Configuration& way = point.way;
  return {{"id", way.id},
          {"title", way.title},
          {"renderer", way.renderer->facts().name},
          {"real", or_null(way.real)},
          {"methods", or_null(way.methods)},
          {"hierarchy", or_null(way.hierarchy)},
          {"samples", way.samples},
          {"output", way.is_program ? Json(renderers::to_string(way.renderer->facts().holds)) : Json()},
          {"against", name_of(way.truth)},
          {"runs", point.runs},
          {"cpu_seconds", json_of(point.cpu_seconds)},
          {"ratio", json_of(point.ratio)},
          {"instructions", or_null(point.instructions)},
          {"instructions_ratio", or_null(point.instructions_ratio)},
          {"error",
           {{"max", point.error.max},
            {"rms", point.error.rms},
            {"pixels_over", point.error.pixels_over},
            {"non_finite", point.error.non_finite}}},
          {"fails", point.fails},
          {"pareto", point.pareto},
          {"measured_before", point.measured_before}};
}

}  // namespace

Json to_json(const studies::Chart& chart) {
  Json json{
      {"plumb", PLUMB_VERSION},
      {"machine", chart.machine},
      {"povray", or_null(chart.povray)},
      {"size", {{"width", chart.options.size.width}, {"height", chart.options.size.height}}},
      {"runs", chart.options.runs},
      {"depth", chart.options.render.depth},
      {"tolerance", 1e-6},
      {"truths",
       {{"pixel_centres", "textbook tracer, 113 bits, one sample through each pixel's centre"},
        {"pixel_areas", "engine, double, " + std::to_string(studies::samples_of_area) + " samples a pixel"}}},
      {"cost",
       "processor time of one thread, the scene's preparation included; of POV-Ray without its start: "
       "less a picture of 2 x 2. ratio: to the fastest of the scene, each run divided by the yardstick "
       "measured just before it"},
      {"yardstick", studies::yardstick().id},
      {"instructions_complaint", or_null(chart.instructions)},
      {"scenes", Json::array()}};
  for (const studies::ChartScene& scene : chart.scenes) {
    Json points = Json::array();
    for (const studies::ChartPoint& point : scene.points) points.push_back(json_of(point));
    json["scenes"].push_back({{"scene", scene.scene}, {"left_out", scene.left_out}, {"points", points}});
  }
  return json;
}

}  // namespace plumb::report
