// Prepares a scene for the engine.
#pragma once

#include "tracer/engine/compiled_scene.hpp"
#include "tracer/engine/settings.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::engine {

/// Expects a scene as read_scene returns it without errors. Composes transforms in double and folds them into
/// spheres (similarities) and boxes (matrices that keep the axes). Keeps what several parents share once when
/// writing it out would be large. Instances have the numbers of a depth-first walk.
template <class Real>
CompiledScene<Real> compile(const Scene& scene, const Settings& settings = {});

extern template CompiledScene<float> compile<float>(const Scene&, const Settings&);
extern template CompiledScene<double> compile<double>(const Scene&, const Settings&);

}  // namespace plumb::engine
