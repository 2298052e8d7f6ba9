// How a tracer writes its colours into a picture, and what tells a colour from the one that is expected.
#pragma once

#include <string>
#include <vector>

#include "tracer/image/image_file.hpp"

namespace plumb::references {

enum class Curve { linear, gamma, srgb };

/// From linear colours to the levels 0 to 255 of a file.
struct OutputEncoding {
  bool tone_map = false;  ///< c / (c + 1), the sheet of 2020
  Curve curve = Curve::linear;
  bool rounds = false;    ///< to the nearest level; the course's framework truncates
  bool is_bgr = false;    ///< red and blue have changed places
  bool is_float = false;  ///< neither rounded nor clamped, in units of 1/255

  /// 2.2 for either curve.
  double gamma() const { return curve == Curve::linear ? 1 : 2.2; }
  /// The level of a linear colour; that of a NaN is 0.
  float level(float colour) const { return rounded(unrounded(colour)); }
  /// In two steps, the first of which is the dear one and the same for every rounding and order of channels.
  float unrounded(float colour) const;
  float rounded(float level) const;
  /// e.g. "tone-mapped, truncated to 8 bits"
  std::string in_words() const;
  bool operator==(const OutputEncoding&) const = default;
};

/// All that a file of this kind may hold, what the course asks for first.
std::vector<OutputEncoding> encodings_of(Sample sample);

}  // namespace plumb::references
