// The picture that is asked for.
#pragma once

#include <optional>
#include <string>

#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb {

/// The size of a picture, in pixels.
struct Size {
  int width;
  int height;
};

/// A picture that is asked for. Scene and camera must outlive it.
struct Shot {
  const Scene& scene;
  const Camera& camera;
  int width;  ///< in pixels
  int height;
  RenderOptions options{};
  std::string file{};  ///< the scene file; empty where the scene was read from none
};

/// Which picture of a scene is wanted.
struct ShotOptions {
  std::optional<Size> size{};  ///< instead of the scene's own
  std::string camera{};        ///< instead of the scene's own, when not empty
  RenderOptions render{};
};

/// Returns the picture that the scene's first render line asks for, as the options change it. The scene must
/// outlive it. Throws std::invalid_argument when the scene has no such camera.
Shot shot_of(const Scene& scene, const ShotOptions& options, const std::string& file = {});

/// Returns how to render it, with the shot's size and options.
RenderJob job_of(const Shot& shot, RenderJob how = {});

}  // namespace plumb
