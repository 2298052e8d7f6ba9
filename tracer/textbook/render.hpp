// Renders a picture with the textbook tracer.
#pragma once

#include "tracer/image/bands.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::textbook {

using plumb::RealType;
using plumb::RenderJob;

/// Renders as below, but hands the picture on band by band.
void render(const Scene& scene, const Camera& camera, const RenderJob& job, const BandSink& sink);

/// Renders linear colours with one sample through each pixel centre. The picture is the same for every number
/// of threads. Expects a scene as read_scene returns it without errors. Throws std::runtime_error on a scene
/// that cannot be traced, and std::invalid_argument when job.samples is not 1.
Image render(const Scene& scene, const Camera& camera, const RenderJob& job);

}  // namespace plumb::textbook
