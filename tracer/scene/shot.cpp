#include "tracer/scene/shot.hpp"

namespace plumb {

Shot shot_of(const Scene& scene, const ShotOptions& options, const std::string& file) {
  const RenderRequest& request = scene.renders.front();
  const Camera& camera = scene.camera(options.camera.empty() ? request.camera : options.camera);
  const Size size = options.size.value_or(Size{request.width, request.height});
  return {scene, camera, size.width, size.height, options.render, file};
}

RenderJob job_of(const Shot& shot, RenderJob how) {
  how.width = shot.width;
  how.height = shot.height;
  how.options = shot.options;
  return how;
}

}  // namespace plumb
