#include "references/renderers/ours.hpp"

#include <utility>

#include "exporters/povray.hpp"
#include "tracer/engine/render.hpp"
#include "tracer/system/stopwatch.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::renderers {
namespace {

/// That of the space in which a scene spans about 1e4 units.
double extent_of(const Scene& scene, const Camera& camera) {
  return 1e4 / exporters::export_space(scene, camera).scale;
}

RendererFacts facts_of(OwnTracer tracer) {
  const bool is_engine = tracer == OwnTracer::engine;
  return {is_engine ? "engine" : "textbook", is_engine ? "plumb's engine" : "plumb's textbook tracer",
          Holds::float32, own_resolution()};
}

}  // namespace

OwnTracer tracer_for(OwnTracer asked, RealType real) {
  return real == RealType::long_double || real == RealType::quad ? OwnTracer::textbook : asked;
}

void render(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
            const BandSink& sink, engine::Statistics* statistics) {
  if (tracer_for(tracer, job.real) == OwnTracer::engine)
    return engine::render(scene, camera, job, sink, statistics);
  const engine::Stopwatch watch;
  textbook::render(scene, camera, job, sink);
  if (statistics != nullptr) {
    statistics->render = watch.elapsed();
    statistics->kernel = "textbook: every ray against every object";
  }
}

Image render(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
             engine::Statistics* statistics) {
  return in_one_band(job.height,
                     [&](const BandSink& sink) { render(tracer, scene, camera, job, sink, statistics); });
}

const Resolution& own_resolution() {
  static constexpr Resolution resolution{
      .extent = &extent_of,
      .step = 1e-12,  // because only roundings of double differ
      .steps_to_blocker = 10,
      // What is told apart in pictures whose rays part needs no such steps: these are as for any reference.
      .touched_edge = 1e-7,
      .one_place = 1e-6,
      .told_apart = 2.5e-8,
      .shadow = 2e-7,
      .is_of_plumb = true};
  return resolution;
}

OurRenderer::OurRenderer(OwnTracer tracer, RenderJob how, engine::Settings settings)
    : Renderer(facts_of(tracer_for(tracer, how.real))),
      tracer_(tracer_for(tracer, how.real)),
      how_(std::move(how)),
      settings_(settings) {}

std::string OurRenderer::version() const { return PLUMB_VERSION; }

Rendered OurRenderer::render(const Shot& shot) const {
  const RenderJob job = job_of(shot, how_);
  return {tracer_ == OwnTracer::engine ? engine::render(shot.scene, shot.camera, job, nullptr, settings_)
                                       : textbook::render(shot.scene, shot.camera, job)};
}

}  // namespace plumb::renderers
