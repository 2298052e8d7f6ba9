// Whole pictures of a condition, held against the oracle pixel by pixel.
#pragma once

#include <functional>
#include <string>

#include "references/studies/stability/trial.hpp"
#include "references/studies/stability/worlds.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/render_job.hpp"

namespace plumb::references::stability {

/// A square picture of so many pixels a side.
using RenderWorld = std::function<Image(const World&, int side)>;

/// The lecture's formulas in that real type.
RenderWorld by_textbook(RealType real);

/// POV-Ray's picture: in the scene's own units, or in those in which plumb exports. Throws Unavailable.
RenderWorld by_povray(bool rescaled);

/// POV-Ray, in the scene's own units, with other blocks of pixels and one thread.
RenderWorld by_povray_in_other_blocks();

/// "POV-Ray 3.7.0.10.unofficial", asked once; empty when there is none.
const std::string& povray_version();

/// A pixel is wrong when it is over 1e-6 of every colour that the scene's numbers leave open (see Oracle); it
/// is missed when it shows the background instead, and shadows itself when it is lit by the ambient light
/// alone instead.
Probe against_oracle(const std::string& condition, RenderWorld render);

/// The same of two pictures that should be one: a pixel is wrong when they differ by more than 1e-6.
Probe against_each_other(const std::string& condition, RenderWorld render, RenderWorld other);

}  // namespace plumb::references::stability
