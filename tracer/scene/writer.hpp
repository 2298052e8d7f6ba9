// Writes a scene in the strict course grammar; reading it again gives the same scene, bit for bit.
#pragma once

#include <string>

#include "tracer/scene/scene.hpp"

namespace plumb {

/// Shortest decimal text that reads back as the same double.
std::string to_text(double value);

std::string write_scene(const Scene& scene);

}  // namespace plumb
