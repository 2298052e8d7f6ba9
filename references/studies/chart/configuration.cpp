#include "references/studies/chart/configuration.hpp"

#include <utility>

#include "references/renderers/ours.hpp"
#include "references/renderers/povray.hpp"
#include "tracer/methods/method_sets.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::studies {
namespace {

const char* name_of(RealType real) {
  if (real == RealType::float32) return "float";
  if (real == RealType::float64) return "double";
  return real == RealType::quad ? "quad" : "long-double";
}

std::string words_of(RealType real) { return real == RealType::long_double ? "long double" : name_of(real); }

RenderJob in_one_thread(RealType real) {
  RenderJob how;
  how.real = real;
  how.threads = 1;
  return how;
}

/// The textbook tracer with other methods.
class MethodRenderer : public renderers::Renderer {
 public:
  MethodRenderer(const methods::MethodSet& methods, RenderJob how)
      : renderers::Renderer({"textbook", "plumb's textbook tracer"}),
        methods_(methods),
        how_(std::move(how)) {}

  std::string version() const override { return PLUMB_VERSION; }
  renderers::Rendered render(const Shot& shot) const override {
    return {methods::render_with_methods(methods_, shot.scene, shot.camera, job_of(shot, how_))};
  }

 private:
  const methods::MethodSet& methods_;
  RenderJob how_;
};

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
  way.real = name_of(real);
  way.hierarchy = hierarchy;
  way.samples = samples;
  way.truth = truth;
  RenderJob how = in_one_thread(real);
  how.samples = samples;
  engine::Settings settings;
  settings.has_hierarchy = hierarchy;
  way.renderer = std::make_shared<renderers::OurRenderer>(renderers::OwnTracer::engine, how, settings);
  return way;
}

Configuration textbook_way(const methods::MethodSet& methods, RealType real) {
  Configuration way;
  way.id = "textbook-" + std::string(name_of(real));
  way.title = "textbook, " + words_of(real);
  if (&methods != &methods::method_sets().front()) {
    way.id += "-" + std::string(methods.id);
    way.title += ", " + std::string(methods.id);
  }
  way.work = way.id;
  way.real = name_of(real);
  way.methods = methods.id;
  way.hierarchy = false;
  // The lecture's formulas known to the compiler: the tracer that users run.
  if (&methods == &methods::method_sets().front())
    way.renderer =
        std::make_shared<renderers::OurRenderer>(renderers::OwnTracer::textbook, in_one_thread(real));
  else
    way.renderer = std::make_shared<MethodRenderer>(methods, in_one_thread(real));
  return way;
}

Configuration povray_way(std::string id, std::string title, renderers::Holds holds,
                         std::vector<std::string> arguments = {}) {
  Configuration way;
  way.id = way.work = "povray-" + std::move(id);
  way.title = "POV-Ray, " + std::move(title);
  way.real = "double";
  way.hierarchy = true;
  way.renderer =
      std::make_shared<renderers::PovrayRenderer>(renderers::PovraySettings{holds, std::move(arguments)});
  way.is_program = true;
  return way;
}

/// Antialiasing after POV-Ray 3.7's manual, section "Anti-Aliasing Options": +AM1 takes up to R * R more
/// samples where neighbours differ by more than the threshold; without jitter, so that runs repeat.
Configuration antialiased(const std::string& id, const std::string& title, const std::string& threshold,
                          int edge) {
  Configuration way = povray_way(id, title, renderers::Holds::float32,
                                 {"+A" + threshold, "+AM1", "+R" + std::to_string(edge), "-J"});
  way.samples = 1 + edge * edge;
  way.truth = Truth::pixel_areas;
  return way;
}

void add_povray(std::vector<Configuration>& ways) {
  ways.push_back(povray_way("state", "state file", renderers::Holds::float32));
  // One run writes both files.
  ways.push_back(povray_way("png16", "PNG16", renderers::Holds::bits16));
  ways.back().work = "povray-state";
  ways.push_back(povray_way("png8", "PNG8", renderers::Holds::bits8));
  ways.push_back(povray_way("samples-1", "1 sample", renderers::Holds::float32));
  ways.back().work = "povray-state";
  ways.back().truth = Truth::pixel_areas;
  ways.push_back(antialiased("aa-default", "+A0.3 +R3", "0.3", 3));
  ways.push_back(antialiased("aa-fine", "+A0.01 +R4", "0.01", 4));
}

std::uint64_t objects_of(const Scene& scene) {
  const auto counts = count_instances(scene);
  std::uint64_t all = 0;
  for (const ShapeId root : scene.roots()) all = saturating_add(all, counts[root]);
  return all;
}

}  // namespace

Configuration yardstick() { return engine_way(RealType::float64, true, 1, Truth::pixel_centres); }

std::vector<Configuration> configurations(const Scene& scene, bool has_povray) {
  std::vector<Configuration> ways;
  const bool without_hierarchy = objects_of(scene) <= most_without_hierarchy;
  for (const RealType real : {RealType::float32, RealType::float64}) {
    ways.push_back(engine_way(real, true, 1, Truth::pixel_centres));
    if (without_hierarchy) ways.push_back(engine_way(real, false, 1, Truth::pixel_centres));
  }
  for (const methods::MethodSet& methods : methods::method_sets()) {
    for (const RealType real : {RealType::float32, RealType::float64})
      ways.push_back(textbook_way(methods, real));
  }
  ways.push_back(textbook_way(methods::method_sets().front(), RealType::long_double));
  for (const RealType real : {RealType::float32, RealType::float64}) {
    for (const int samples : {1, 4, 16}) ways.push_back(engine_way(real, true, samples, Truth::pixel_areas));
  }
  if (has_povray) add_povray(ways);
  return ways;
}

std::vector<std::string> left_out(const Scene& scene, bool has_povray) {
  std::vector<std::string> notes;
  if (objects_of(scene) > most_without_hierarchy)
    notes.push_back("the engine without a hierarchy: found " + std::to_string(objects_of(scene)) +
                    " objects, expected at most " + std::to_string(most_without_hierarchy));
  if (!has_povray) notes.emplace_back("POV-Ray: it is not on PATH (apt-get install povray)");
  return notes;
}

}  // namespace plumb::studies
