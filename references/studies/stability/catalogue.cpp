#include "references/studies/stability/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "references/studies/stability/conditions.hpp"
#include "references/studies/stability/embree.hpp"
#include "references/studies/stability/rendered.hpp"

namespace plumb::studies::stability {
namespace {

/// What is no number is farther off than any other.
double farther(double a, double b) {
  return std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

Method pictures(const Words& words, const char* real, const std::string& renderer, Probe probe) {
  return {words.id,     words.source,    words.cause,
          words.remedy, Measure::pixels, {{real, std::move(probe), renderer}}};
}

constexpr const char* absolute = "its tolerances are absolute: depth 1e-6, nearest hit 1e-4, shadow 1e-3";

/// POV-Ray counts in double.
void add_povray(ConditionEntry& entry) {
  entry.methods.push_back(
      pictures({"povray", "POV-Ray 3.7, the scene's own units", absolute, "export the scene scaled"},
               "double", povray_version(), against_oracle(entry.name, by_povray(false))));
  entry.methods.push_back(pictures({"povray-rescaled", "POV-Ray 3.7, as plumb exports", absolute,
                                    "no single scale fits both sizes: judge the pixels by 113 bits"},
                                   "double", povray_version(), against_oracle(entry.name, by_povray(true))));
}

/// Whole pictures by the lecture's formulas, where no single ray shows the condition.
void add_lecture_pictures(ConditionEntry& entry) {
  Method method{lecture.id, lecture.source, lecture.cause, lecture.remedy, Measure::pixels, {}};
  for (const auto& [name, real] :
       {std::pair("float", RealType::float32), std::pair("double", RealType::float64),
        std::pair("long-double", RealType::long_double)})
    method.variants.push_back({name, against_oracle(entry.name, by_textbook(real)), ""});
  entry.methods.push_back(std::move(method));
}

ConditionEntry picture_condition(const char* name, const char* unit, double last) {
  ConditionEntry entry{name, unit, last, false, 0, {}};
  add_lecture_pictures(entry);
  return entry;
}

ConditionEntry block_size() {
  ConditionEntry entry{"block-size", "1 / scene scale", 1e9, false, 0, {}};
  entry.methods.push_back(
      pictures({"povray-blocks", "POV-Ray 3.7, +BS4 +WT1 instead of +WT2",
                "what a ray meets first is remembered from pixel to pixel, and tolerances are absolute",
                "export the scene scaled"},
               "double", povray_version(),
               against_each_other(entry.name, by_povray(false), by_povray_in_other_blocks())));
  return entry;
}

}  // namespace

Probe of_rays(Experiment experiment) {
  return [experiment = std::move(experiment)](double value, int rays) {
    Random random(1);
    Outcome all;
    int asked = 0;
    for (int i = 0; i < rays; ++i) {
      const Trial trial = experiment(value, random);
      if (!trial.counts) continue;
      ++asked;
      all.missed |= trial.missed;
      all.self_shadow |= trial.self_shadow;
      const bool is_wrong = trial.missed || trial.self_shadow || !(trial.relative <= 0.01);
      all.wrong += is_wrong ? 1 : 0;
      if (trial.missed) continue;
      all.ulps = farther(all.ulps, trial.ulps);
      all.relative = farther(all.relative, trial.relative);
    }
    all.counts = asked > 0;
    if (all.counts) all.wrong /= asked;
    return all;
  };
}

Method by_embree(const char* id, const char* source, Experiment experiment) {
  return {id,
          source,
          "24 bits of a float, and the reciprocals of the hierarchy",
          "doubles, or coordinates near the object",
          Measure::t,
          {{"float", of_rays(std::move(experiment)), embree_version()}}};
}

std::vector<ConditionEntry> catalogue() {
  std::vector<ConditionEntry> all;
  for (const auto kind : {&conditions_of_spheres, &conditions_of_boxes, &conditions_of_transforms,
                          &conditions_of_secondary_rays})
    std::ranges::move(kind(), std::back_inserter(all));
  all.push_back(picture_condition("thin-glass", "1 / thickness of a pane", 1e9));
  all.push_back(picture_condition("gap", "1 / gap between glass and floor", 1e9));
  for (ConditionEntry& entry : all) {
    if (world_of(entry.name, 2)) add_povray(entry);
  }
  all.push_back(block_size());
  for (ConditionEntry& entry : all) {
    for (Method& method : entry.methods) explain(entry.name, method);
  }
  return all;
}

}  // namespace plumb::studies::stability
