// Renders a whole picture with the engine.
#pragma once

#include "tracer/engine/settings.hpp"
#include "tracer/engine/statistics.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::engine {

/// Linear colours, one sample through each pixel centre, as the textbook tracer computes them; the same for
/// every number of threads and every width of vectors. Expects a scene as read_scene returns it without
/// errors and a real type of 32 or 64 bits. Throws std::runtime_error on a scene that cannot be traced.
Image render(const Scene& scene, const Camera& camera, const RenderJob& job, Statistics* statistics = nullptr,
             const Settings& settings = {});

}  // namespace plumb::engine
