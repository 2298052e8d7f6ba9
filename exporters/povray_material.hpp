// Layered textures: POV-Ray's phong is a scalar, so RGB coefficients need layers.
#pragma once

#include <string>

#include "tracer/scene/scene.hpp"

namespace plumb::exporters {

/// `x y z` as an SDL vector <x,y,z>.
std::string sdl(const Vec3d& v);

/// The texture blocks of a material under the ambient light Ia, bottom layer first, only those that it needs.
std::string povray_texture(const Material& material, const Rgbd& ambient);

}  // namespace plumb::exporters
