// The constants of FLIP: filters, colour matrices, exponents.
#pragma once

#include <array>

namespace plumb::comparison::flip_model {

/// One half of a filter that is even or odd about its centre; weight 0 is the centre's.
inline constexpr int most_taps = 16;
using Taps = std::array<float, most_taps>;

struct Model {
  // 2020, section 4.1.1: contrast sensitivity as Gaussians; blue-yellow is a sum of two.
  int colour_radius = 0;
  Taps achromatic{};
  Taps red_green{};
  Taps blue_yellow_1{};
  Taps blue_yellow_2{};
  // 2020, section 4.2: a Gaussian, its first and its second derivative.
  int feature_radius = 0;
  Taps smooth{};
  Taps edge{};
  Taps point{};
  // Linear sRGB to XYZ over the XYZ of white, and back.
  std::array<float, 9> white_from_rgb{};
  std::array<float, 9> rgb_from_white{};
  // 2020, section 4.1.3: the largest colour difference, that between green and blue, to the power of 0.7.
  float largest = 0;
};

/// Returns the same model at every call.
const Model& model();

}  // namespace plumb::comparison::flip_model
