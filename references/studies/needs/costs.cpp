#include "references/studies/needs/costs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "references/attribution/terms.hpp"
#include "tracer/engine/render.hpp"

namespace plumb::studies {
namespace {

/// The picture without one thing.
struct Variant {
  std::string feature;
  Scene scene;
  RenderJob job;
};

std::vector<Variant> variants_of(const Scene& scene, const RenderJob& job, const Untouched& untouched) {
  std::vector<Variant> all;
  const auto add = [&](const char* feature, bool has, const auto& take_out) {
    if (!has) return;
    all.push_back({feature, scene, job});
    take_out(all.back());
  };
  const auto of_materials = [](const auto& take_out) {
    return [&take_out](Variant& v) {
      std::for_each(v.scene.materials.begin(), v.scene.materials.end(), take_out);
    };
  };
  const auto no_highlight = [](Material& m) { m.ks = Rgbd(0); };
  const auto no_mirror = [](Material& m) { m.mirror = Rgbd(0); };
  const auto no_glass = [](Material& m) { m.transmit = Rgbd(0); };
  const bool has_mirror = attribution::has(attribution::Term::mirror, scene),
             has_glass = attribution::has(attribution::Term::refraction, scene);
  add("highlights", attribution::has(attribution::Term::specular, scene), of_materials(no_highlight));
  add("shadows", attribution::has(attribution::Term::shadow, scene) && job.options.shadows,
      [](Variant& v) { v.job.options.shadows = false; });
  add("lights", !scene.lights.empty(), [](Variant& v) { v.scene.lights.clear(); });
  add("mirrors", has_mirror, of_materials(no_mirror));
  add("refraction", has_glass, of_materials(no_glass));
  add("all secondary rays", (has_mirror || has_glass) && job.options.depth > 1,
      [](Variant& v) { v.job.options.depth = 1; });
  add("what no ray touches", !untouched.shapes.empty() || !untouched.lights.empty(),
      [&](Variant& v) { v.scene = without(scene, untouched); });
  add("double instead of float", true, [](Variant& v) { v.job.real = RealType::float32; });
  return all;
}

double cpu_of(const Scene& scene, const Camera& camera, const RenderJob& job) {
  engine::Statistics statistics;
  engine::render(scene, camera, job, &statistics);
  return statistics.build.cpu + statistics.render.cpu;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns an odd number, large enough for short renders to take a tenth of a second in all.
int rounds_for(double cpu_seconds) {
  return 2 * static_cast<int>(std::clamp(0.05 / std::max(cpu_seconds, 1e-4), 1.0, 7.0)) + 1;
}

FeatureCost cost_of(const std::string& feature, const std::vector<double>& ratios) {
  const auto [least, greatest] = std::minmax_element(ratios.begin(), ratios.end());
  return {feature, median(ratios), *least, *greatest};
}

}  // namespace

Costs measure_costs(const Scene& scene, const Camera& camera, const RenderJob& asked,
                    const Untouched& untouched) {
  RenderJob job = asked;
  job.threads = 1;
  job.progress = {};
  job.real = RealType::float64;
  const std::vector<Variant> variants = variants_of(scene, job, untouched);
  Costs costs;
  costs.rounds = rounds_for(cpu_of(scene, camera, job));
  std::vector<double> whole;
  std::vector<std::vector<double>> ratios(variants.size());
  for (int round = 0; round < costs.rounds; ++round) {
    whole.push_back(cpu_of(scene, camera, job));
    for (std::size_t i = 0; i < variants.size(); ++i) {
      ratios[i].push_back(whole.back() / cpu_of(variants[i].scene, camera, variants[i].job));
    }
    if (asked.progress) asked.progress((round + 1.0) / costs.rounds);
  }
  costs.cpu_seconds = median(whole);
  for (std::size_t i = 0; i < variants.size(); ++i)
    costs.costs.push_back(cost_of(variants[i].feature, ratios[i]));
  return costs;
}

}  // namespace plumb::studies
