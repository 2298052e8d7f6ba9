// Probes a condition with complete pictures, compared with the oracle pixel by pixel.
#pragma once

#include <memory>
#include <string>

#include "references/renderers/renderer.hpp"
#include "references/studies/stability/trial.hpp"
#include "references/studies/stability/worlds.hpp"
#include "tracer/scene/render_job.hpp"

namespace plumb::studies::stability {

using RendererOfWorlds = std::shared_ptr<const renderers::Renderer>;

/// The lecture's formulas in that real type.
RendererOfWorlds by_textbook(RealType real);

/// POV-Ray: in the scene's own units, or in those in which plumb exports. Its render() throws Unavailable.
RendererOfWorlds by_povray(bool rescaled);

/// POV-Ray, in the scene's own units, with other blocks of pixels and one thread.
RendererOfWorlds by_povray_in_other_blocks();

/// Returns e.g. "POV-Ray 3.7.0.10.unofficial", asked once; empty when there is none.
const std::string& povray_version();

/// A square picture of so many pixels a side. Throws what the renderer throws.
Image picture_of(const renderers::Renderer& renderer, const World& world, int side);

/// A pixel is wrong when it is over 1e-6 of every colour that the scene's numbers leave open (see Oracle); it
/// is missed when it shows the background instead, and shadows itself when it is lit by the ambient light
/// alone instead.
Probe against_oracle(const std::string& condition, RendererOfWorlds renderer);

/// The same of two pictures that should be one: a pixel is wrong when they differ by more than 1e-6.
Probe against_each_other(const std::string& condition, RendererOfWorlds renderer, RendererOfWorlds other);

}  // namespace plumb::studies::stability
