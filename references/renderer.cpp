#include "references/renderer.hpp"

#include "tracer/engine/render.hpp"
#include "tracer/engine/stopwatch.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::references {

Image render(Renderer renderer, const Scene& scene, const Camera& camera, const RenderJob& job,
             engine::Statistics* statistics) {
  if (renderer == Renderer::engine && job.real != RealType::long_double)
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
