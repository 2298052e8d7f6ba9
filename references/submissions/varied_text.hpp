// Writes a scene's text with other numbers and names, in the same words, order and dialect.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb::submissions {

/// How much is varied.
struct Variation {
  std::function<double()> random;             ///< returns -1 to 1, evenly
  double places = 1;                          ///< how much positions and sizes vary; 0: not at all
  double colours = 1;                         ///< how much colours vary
  std::array<std::size_t, 3> order{0, 1, 2};  ///< which channel of a colour becomes red, green and blue
};

/// Positions, radii, corners, field of view and colours vary. A number that is 0 stays, and so do exponents,
/// indices of refraction, scales, angles and sizes of pictures, because scenes are about those. Materials,
/// lights, cameras, spheres and boxes get new names; composites keep theirs, because some tracers look for
/// one of them. Comments go, because they may name the scene. `scene` is what the text was read as.
std::string varied_text(std::string_view text, const Scene& scene, const Variation& variation);

}  // namespace plumb::submissions
