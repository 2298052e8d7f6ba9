#include "references/report/needs_json.hpp"

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;

Json features_json(const studies::Needs& needs) {
  Json all = Json::array();
  for (const studies::Feature& f : needs.features)
    all.push_back(
        {{"id", f.id}, {"slide", f.slide}, {"what", f.what}, {"in_scene", f.in_scene}, {"seen", f.seen}});
  return all;
}

Json real_json(const NeedsReport& r) {
  Json json{{"sufficient", studies::sufficient_real(r.needs, r.bound)},
            {"oracle_pixels", r.needs.oracle_pixels},
            {"pixels", r.needs.observed.pixels}};
  for (const auto* c : {&r.needs.in_float, &r.needs.in_double})
    json[studies::to_string(c->real)] = {{"error_against_oracle", c->error.against_oracle},
                                         {"error_against_double", c->error.against_double.value_or(0)}};
  for (const double bound : bounds_of(r))
    json["bounds"].push_back({{"error", bound}, {"sufficient", studies::sufficient_real(r.needs, bound)}});
  return json;
}

Json depth_json(const studies::Needs& needs) {
  const studies::DepthNeed& d = needs.depth;
  Json json{{"asked", d.asked},
            {"same_from", d.same_from},
            {"within_error_from", d.within_bound_from},
            {"deepest_ray", needs.observed.deepest},
            {"rays_black_at_limit", needs.observed.black_at_limit},
            {"change_of_next_depth", d.change_beyond}};
  for (const studies::DepthStep& step : d.steps)
    json["steps"].push_back({{"depth", step.depth}, {"error", step.error}});
  return json;
}

Json costs_json(const studies::Costs& costs) {
  Json json{{"cpu_seconds", costs.cpu_seconds}, {"rounds", costs.rounds}};
  for (const studies::FeatureCost& c : costs.costs)
    json["with_against_without"].push_back(
        {{"feature", c.feature}, {"median", c.ratio}, {"least", c.least}, {"greatest", c.greatest}});
  return json;
}

}  // namespace

Json to_json(const NeedsReport& r) {
  const studies::Needs& n = r.needs;
  return {{"tool", "plumb"},
          {"version", PLUMB_VERSION},
          {"scene", r.path},
          {"width", r.width},
          {"height", r.height},
          {"error", r.bound},
          {"observed",
           {{"pixels", n.observed.pixels}, {"looked_at", n.observed.looked_at}, {"cut", n.observed.cut}}},
          {"features", features_json(n)},
          {"real", real_json(r)},
          {"depth", depth_json(n)},
          {"untouched",
           {{"shapes", names_of(n.untouched.shapes, r.scene.shapes)},
            {"materials", names_of(n.untouched.materials, r.scene.materials)},
            {"lights", names_of(n.untouched.lights, r.scene.lights)},
            {"same_picture_without", n.is_same_without_untouched}}},
          {"costs", costs_json(n.costs)}};
}

}  // namespace plumb::report
