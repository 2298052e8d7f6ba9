// Writes a scene in the strict course grammar; reading it again gives the same scene, bit for bit.
#pragma once

#include <string>

#include "tracer/scene/scene.hpp"

namespace plumb {

std::string write_scene(const Scene& scene);

}  // namespace plumb
