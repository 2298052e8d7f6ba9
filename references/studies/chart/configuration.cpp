#include "references/studies/chart/configuration.hpp"

#include <utility>

#include "exporters/povray.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/methods/method_sets.hpp"
#include "tracer/scene/hierarchy.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::references {
namespace {

const char* name_of(RealType real) {
  if (real == RealType::float32) return "float";
  if (real == RealType::float64) return "double";
  return real == RealType::quad ? "quad" : "long-double";
}

std::string words_of(RealType real) { return real == RealType::long_double ? "long double" : name_of(real); }

Configuration engine_way(RealType real, bool hierarchy, int samples, Truth truth) {
  Configuration way;
  way.id = "engine-" + std::string(name_of(real));
  way.title = "engine, " + words_of(real);
  if (!hierarchy) way.id += "-brute-force", way.title += ", no hierarchy";
  way.work = way.id + "-" + std::to_string(samples);
  if (truth == Truth::pixel_areas) {
    way.id += "-samples-" + std::to_string(samples);
    way.title += ", " + std::to_string(samples) + (samples == 1 ? " sample" : " samples");
  }
  way.renderer = "engine";
  way.real = name_of(real);
  way.hierarchy = hierarchy;
  way.samples = samples;
  way.truth = truth;
  way.render = [real, hierarchy, samples](const ChartView& view) {
    RenderJob job = view.job;
    job.real = real;
    job.samples = samples;
    engine::Settings settings;
    settings.has_hierarchy = hierarchy;
    return engine::render(view.scene, view.camera, job, nullptr, settings);
  };
  return way;
}

Configuration textbook_way(const MethodSet& methods, RealType real) {
  Configuration way;
  way.id = "textbook-" + std::string(name_of(real));
  way.title = "textbook, " + words_of(real);
  if (&methods != &method_sets().front()) {
    way.id += "-" + std::string(methods.id);
    way.title += ", " + std::string(methods.id);
  }
  way.work = way.id;
  way.renderer = "textbook";
  way.real = name_of(real);
  way.methods = methods.id;
  way.hierarchy = false;
  way.render = [&methods, real](const ChartView& view) {
    RenderJob job = view.job;
    job.real = real;
    // Its formulas known to the compiler: the tracer that users run.
    if (&methods == &method_sets().front()) return textbook::render(view.scene, view.camera, job);
    return render_with_methods(methods, view.scene, view.camera, job);
  };
  return way;
}

PovrayJob povray_job(const ChartView& view, const std::vector<std::string>& arguments, Holds holds, int width,
                     int height) {
  const auto exported = exporters::export_povray(view.scene, view.camera, width, height, view.job.options);
  PovrayJob job{exported.text, width, height, exported.needs_flat_objects};
  job.more_arguments = arguments;
  job.holds = holds;
  return job;
}

Configuration povray_way(const Povray& povray, std::string id, std::string title, Holds holds,
                         const std::vector<std::string>& arguments) {
  Configuration way;
  way.id = way.work = "povray-" + std::move(id);
  way.title = "POV-Ray, " + std::move(title);
  way.renderer = "povray";
  way.real = "double";
  way.hierarchy = true;
  way.output = to_string(holds);
  const auto run = [&povray, holds, arguments](const ChartView& view, int width, int height) {
    return povray.render(povray_job(view, arguments, holds, width, height)).image;
  };
  way.render = [run](const ChartView& view) { return run(view, view.job.width, view.job.height); };
  way.start = [run](const ChartView& view) { run(view, 2, 2); };
  return way;
}

/// Antialiasing after POV-Ray 3.7's manual, section "Anti-Aliasing Options": +AM1 takes up to R * R more
/// samples where neighbours differ by more than the threshold; without jitter, so that runs repeat.
Configuration antialiased(const Povray& povray, const std::string& id, const std::string& title,
                          const std::string& threshold, int edge) {
  Configuration way = povray_way(povray, id, title, Holds::float32,
                                 {"+A" + threshold, "+AM1", "+R" + std::to_string(edge), "-J"});
  way.samples = 1 + edge * edge;
  way.truth = Truth::pixel_areas;
  return way;
}

void add_povray(const Povray& povray, std::vector<Configuration>& ways) {
  ways.push_back(povray_way(povray, "state", "state file", Holds::float32, {}));
  // One run writes both files.
  ways.push_back(povray_way(povray, "png16", "PNG16", Holds::bits16, {}));
  ways.back().work = "povray-state";
  ways.push_back(povray_way(povray, "png8", "PNG8", Holds::bits8, {}));
  ways.push_back(povray_way(povray, "samples-1", "1 sample", Holds::float32, {}));
  ways.back().work = "povray-state";
  ways.back().truth = Truth::pixel_areas;
  ways.push_back(antialiased(povray, "aa-default", "+A0.3 +R3", "0.3", 3));
  ways.push_back(antialiased(povray, "aa-fine", "+A0.01 +R4", "0.01", 4));
}

std::uint64_t objects_of(const Scene& scene) {
  const auto counts = count_instances(scene);
  std::uint64_t all = 0;
  for (const ShapeId root : scene.roots()) all = saturating_add(all, counts[root]);
  return all;
}

}  // namespace

Configuration yardstick() { return engine_way(RealType::float64, true, 1, Truth::pixel_centres); }

std::vector<Configuration> configurations(const Scene& scene, const Povray* povray) {
  std::vector<Configuration> ways;
  const bool without_hierarchy = objects_of(scene) <= most_without_hierarchy;
  for (const RealType real : {RealType::float32, RealType::float64}) {
    ways.push_back(engine_way(real, true, 1, Truth::pixel_centres));
    if (without_hierarchy) ways.push_back(engine_way(real, false, 1, Truth::pixel_centres));
  }
  for (const MethodSet& methods : method_sets()) {
    for (const RealType real : {RealType::float32, RealType::float64})
      ways.push_back(textbook_way(methods, real));
  }
  ways.push_back(textbook_way(method_sets().front(), RealType::long_double));
  for (const RealType real : {RealType::float32, RealType::float64}) {
    for (const int samples : {1, 4, 16}) ways.push_back(engine_way(real, true, samples, Truth::pixel_areas));
  }
  if (povray != nullptr) add_povray(*povray, ways);
  return ways;
}

std::vector<std::string> left_out(const Scene& scene, const Povray* povray) {
  std::vector<std::string> notes;
  if (objects_of(scene) > most_without_hierarchy)
    notes.push_back("the engine without a hierarchy: found " + std::to_string(objects_of(scene)) +
                    " objects, expected at most " + std::to_string(most_without_hierarchy));
  if (povray == nullptr) notes.emplace_back("POV-Ray: it is not on PATH (apt-get install povray)");
  return notes;
}

}  // namespace plumb::references
