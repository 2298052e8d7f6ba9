// Plumb as a renderer: which of its two tracers renders a picture.
#pragma once

#include "references/renderers/renderer.hpp"
#include "tracer/engine/settings.hpp"
#include "tracer/engine/statistics.hpp"
#include "tracer/image/bands.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::renderers {

/// The readable one, or the fast one; both give the same picture.
enum class OwnTracer { textbook, engine };

/// Returns what renders when this one is asked for a picture in that real type.
OwnTracer tracer_for(OwnTracer asked, RealType real);

/// Renders as below, but hands the picture on band by band.
void render(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
            const BandSink& sink, engine::Statistics* statistics = nullptr);

/// Renders a picture. The engine knows float and double; the textbook tracer renders what is asked of it in
/// another real type. `statistics` may be null; the textbook tracer sets the time alone.
Image render(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
             engine::Statistics* statistics = nullptr);

/// Of pictures that plumb renders in double, here or on another machine.
const Resolution& own_resolution();

/// As render() above, with a shot's size and options.
class OurRenderer : public Renderer {
 public:
  /// The settings are the engine's.
  explicit OurRenderer(OwnTracer tracer, RenderJob how = {}, engine::Settings settings = {});

  std::string version() const override;
  Rendered render(const Shot& shot) const override;

 private:
  OwnTracer tracer_;
  RenderJob how_;
  engine::Settings settings_;
};

}  // namespace plumb::renderers
