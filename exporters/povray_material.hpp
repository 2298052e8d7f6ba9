// Writes layered textures: POV-Ray's phong is a scalar, so RGB coefficients need layers.
#pragma once

#include <string>

#include "tracer/scene/scene.hpp"

namespace plumb::exporters {

/// Returns an SDL vector <x,y,z>.
std::string sdl(const Vec3d& v);

/// Returns the texture blocks of a material under the ambient light Ia: the bottom layer first, and only the
/// layers that it needs.
std::string povray_texture(const Material& material, const Rgbd& ambient);

}  // namespace plumb::exporters
