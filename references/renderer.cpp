#include "references/renderer.hpp"

#include "tracer/engine/render.hpp"
#include "tracer/engine/stopwatch.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::references {

Renderer renderer_for(Renderer asked, RealType real) {
  return real == RealType::long_double ? Renderer::textbook : asked;
}

Image render(Renderer renderer, const Scene& scene, const Camera& camera, const RenderJob& job,
             engine::Statistics* statistics) {
  if (renderer_for(renderer, job.real) == Renderer::engine)
    return engine::render(scene, camera, job, statistics);
  const engine::Stopwatch watch;
  Image image = textbook::render(scene, camera, job);
  if (statistics != nullptr) {
    statistics->render = watch.elapsed();
    statistics->kernel = "textbook: every ray against every object";
  }
  return image;
}

}  // namespace plumb::references
