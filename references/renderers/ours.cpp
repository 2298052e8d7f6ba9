#include "references/renderers/ours.hpp"

#include "tracer/engine/render.hpp"
#include "tracer/system/stopwatch.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::references {

Renderer renderer_for(Renderer asked, RealType real) {
  return real == RealType::long_double || real == RealType::quad ? Renderer::textbook : asked;
}

void render(Renderer renderer, const Scene& scene, const Camera& camera, const RenderJob& job,
            const BandSink& sink, engine::Statistics* statistics) {
  if (renderer_for(renderer, job.real) == Renderer::engine)
    return engine::render(scene, camera, job, sink, statistics);
  const engine::Stopwatch watch;
  textbook::render(scene, camera, job, sink);
  if (statistics != nullptr) {
    statistics->render = watch.elapsed();
    statistics->kernel = "textbook: every ray against every object";
  }
}

Image render(Renderer renderer, const Scene& scene, const Camera& camera, const RenderJob& job,
             engine::Statistics* statistics) {
  return in_one_band(job.height,
                     [&](const BandSink& sink) { render(renderer, scene, camera, job, sink, statistics); });
}

}  // namespace plumb::references
