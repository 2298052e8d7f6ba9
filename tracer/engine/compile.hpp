// Makes a scene ready for the engine.
#pragma once

#include "tracer/engine/compiled_scene.hpp"
#include "tracer/engine/settings.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::engine {

/// Expects a scene as read_scene returns it without errors. Transforms are composed in double and folded into
/// spheres (similarities) and boxes (axes kept); what several parents share is kept once when writing it out
/// would be large. Instances have the numbers that a depth-first walk gives them.
template <class Real>
CompiledScene<Real> compile(const Scene& scene, const Settings& settings = {});

extern template CompiledScene<float> compile<float>(const Scene&, const Settings&);
extern template CompiledScene<double> compile<double>(const Scene&, const Settings&);

}  // namespace plumb::engine
