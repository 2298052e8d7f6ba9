// Renders a picture with the engine.
#pragma once

#include "tracer/engine/settings.hpp"
#include "tracer/engine/statistics.hpp"
#include "tracer/image/bands.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::engine {

/// Renders as below, but hands the picture on band by band. While a band is taken, the next is rendered. What
/// the sink throws ends the render and is thrown again.
void render(const Scene& scene, const Camera& camera, const RenderJob& job, const BandSink& sink,
            Statistics* statistics = nullptr, const Settings& settings = {});

/// Renders linear colours as the textbook tracer computes them: the mean of job.samples samples per pixel.
/// The picture is the same for every number of threads, every width of vectors and every size of tiles.
/// Expects a scene as read_scene returns it without errors and a real type of 32 or 64 bits. Throws
/// std::runtime_error on a scene that cannot be traced, and what sample_points() throws.
Image render(const Scene& scene, const Camera& camera, const RenderJob& job, Statistics* statistics = nullptr,
             const Settings& settings = {});

}  // namespace plumb::engine
