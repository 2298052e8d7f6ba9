// How a tracer writes its colours into a picture, and what tells a colour from the one that is expected.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tracer/image/image_file.hpp"

namespace plumb::references {

enum class Curve { linear, gamma, srgb };

/// How a picture of fewer levels was made of one of 8 bits, if it was.
enum class Reduced { no, truncated, rounded, equal_parts };

/// From linear colours to the levels 0 to 255 of a file.
struct OutputEncoding {
  bool tone_map = false;  ///< c / (c + 1), the sheet of 2020
  Curve curve = Curve::linear;
  bool rounds = false;           ///< to the nearest level; the course's framework truncates
  bool is_float = false;         ///< neither rounded nor clamped, in units of 1/255
  bool has_equal_parts = false;  ///< truncated after a product with the number of levels, not with one less
  std::array<bool, 3> has_upper_bits{};  ///< a level of fewer is the upper bits of a byte: equal parts, too
  Reduced reduced = Reduced::no;
  std::array<int, 3> levels{256, 256, 256};  ///< of red, green and blue in the file; 2 to 65536
  /// Of a picture of floats, the share of a value (or of the largest of a pixel, where all share one
  /// exponent) that its file does not hold.
  float lost = 0;
  bool shares_exponent = false;

  /// 2.2 for either curve.
  double gamma() const { return curve == Curve::linear ? 1 : 2.2; }
  bool has_256_levels() const { return levels == std::array{256, 256, 256}; }
  /// The level of a linear colour in a channel of the file; in integers that of a NaN is 0.
  float level(float colour, std::size_t channel) const { return rounded(unrounded(colour), channel); }
  /// In two steps, the first of which is the dear one and the same for every rounding.
  float unrounded(float colour) const;
  /// On the scale of 0 to 255, however many levels there are.
  float rounded(float level, std::size_t channel) const;
  /// How far a right tracer's unrounded level may be off in the file, beside what its colour is off by.
  float slack(float level, const float* seen, std::size_t channel) const;
  /// e.g. "tone-mapped, truncated to 8 bits"
  std::string in_words() const;
  bool operator==(const OutputEncoding&) const = default;

 private:
  std::string depth_in_words() const;
};

/// All that a file that was read like this may hold, what the course asks for first. `read` says what is
/// known of the levels.
std::vector<OutputEncoding> encodings_of(const OutputEncoding& read);

}  // namespace plumb::references
