// How a tracer writes its colours into a picture, and how far these may be from what is expected.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tracer/image/image_file.hpp"

namespace plumb::diagnosis {

enum class Curve { linear, gamma, srgb };

/// How a picture of fewer levels was made from one of 8 bits, if it was.
enum class Reduced { no, truncated, rounded, equal_parts };

/// The way from linear colours to the levels 0 to 255 of a file.
struct OutputEncoding {
  bool tone_map = false;  ///< c / (c + 1), the sheet of 2020
  Curve curve = Curve::linear;
  bool rounds = false;                   ///< true: to the nearest level; the course's framework truncates
  bool is_float = false;                 ///< neither rounded nor clamped; levels in units of 1/255
  bool has_equal_parts = false;          ///< truncates a product with the number of levels, not with one less
  std::array<bool, 3> has_upper_bits{};  ///< levels are the upper bits of a byte: equal parts, too
  Reduced reduced = Reduced::no;
  std::array<int, 3> levels{256, 256, 256};  ///< of red, green and blue in the file; 2 to 65536
  /// In a picture of floats, the share of a value that its file does not hold. Where all of a pixel share one
  /// exponent, it is a share of the largest.
  float lost = 0;
  bool shares_exponent = false;

  /// 2.2 for either curve, 1 without one.
  double gamma() const { return curve == Curve::linear ? 1 : 2.2; }
  bool has_256_levels() const { return levels == std::array{256, 256, 256}; }
  /// Returns the level of a linear colour in a channel of the file; in integers that of a NaN is 0.
  float level(float colour, std::size_t channel) const { return rounded(unrounded(colour), channel); }
  /// Applies tone map and curve alone. This step is the costly one; all roundings share it.
  float unrounded(float colour) const;
  /// Rounds such a level, on the scale of 0 to 255, however many levels there are.
  float rounded(float level, std::size_t channel) const;
  /// Returns how far a right tracer's unrounded level may be off in the file, beyond what its colour is off
  /// by.
  float slack(float level, const float* seen, std::size_t channel) const;
  /// Returns e.g. "tone-mapped, truncated to 8 bits".
  std::string in_words() const;
  bool operator==(const OutputEncoding&) const = default;

 private:
  std::string depth_in_words() const;
};

/// Returns all encodings that a file which was read like this may have; what the course asks for comes first.
/// `read` says what is known of the levels.
std::vector<OutputEncoding> encodings_of(const OutputEncoding& read);

}  // namespace plumb::diagnosis
