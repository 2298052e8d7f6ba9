// Which of the two tracers renders a picture.
#pragma once

#include "tracer/engine/statistics.hpp"
#include "tracer/image/bands.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// The readable one, or the fast one; both give the same picture.
enum class Renderer { textbook, engine };

/// What renders when this one is asked for a picture in that real type.
Renderer renderer_for(Renderer asked, RealType real);

/// Hands the picture on, band by band; otherwise as below.
void render(Renderer renderer, const Scene& scene, const Camera& camera, const RenderJob& job,
            const BandSink& sink, engine::Statistics* statistics = nullptr);

/// The engine knows float and double; what is asked of it in another real type, the textbook tracer renders.
/// `statistics` may be null; of the textbook tracer they say the time alone.
Image render(Renderer renderer, const Scene& scene, const Camera& camera, const RenderJob& job,
             engine::Statistics* statistics = nullptr);

}  // namespace plumb::references
