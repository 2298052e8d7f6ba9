#include "references/diagnosis/output_encoding.hpp"

#include <algorithm>
#include <cmath>

#include "tracer/image/encode.hpp"

namespace plumb::diagnosis {
namespace {

constexpr float white_level = 255;
/// because a curve and a product in float32 lose less than ten units in the last place, 6e-8 each
constexpr float lost_by_encoding = 1e-6F;
/// What a factor may lose, because 255.99 is as common a factor as 256; in 255ths of the step of 256 levels.
constexpr float lost_by_factor = 0.011F;

float reduced_to_8_bits(float level, Reduced reduced) {
  switch (reduced) {
    case Reduced::truncated:
      return std::floor(level);
    case Reduced::rounded:
      return std::floor(level + 0.5F);
    case Reduced::equal_parts:
      return std::min(white_level, std::floor(level * ((white_level + 1) / white_level)));
    case Reduced::no:
      break;
  }
  return level;
}

/// Returns the power of two that is the exponent of a value, in the units of a file: 255 for 1.
float power_of_two_below(float value) {
  return value > 0 && std::isfinite(value)
             ? white_level * std::exp2(std::floor(std::log2(value / white_level)))
             : 0;
}

float curved(float c, Curve curve) {
  if (curve == Curve::linear || !(c > 0)) return c;
  if (curve == Curve::gamma) return std::pow(c, 1 / 2.2F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
}

}  // namespace

float OutputEncoding::unrounded(float colour) const {
  return white_level * curved(tone_map ? tone_mapped(colour) : colour, curve);
}

float OutputEncoding::rounded(float level, std::size_t channel) const {
  if (is_float) return level;
  if (std::isnan(level)) return 0;
  const auto steps = static_cast<float>(levels.at(channel) - 1);
  level = reduced_to_8_bits(level, reduced);
  const bool is_upper = has_upper_bits.at(channel);
  const float scaled = level * ((has_equal_parts || is_upper ? steps + 1 : steps) / white_level);
  const float step = std::clamp(std::floor(rounds && !is_upper ? scaled + 0.5F : scaled), 0.0F, steps);
  return white_level * step / steps;
}

float OutputEncoding::slack(float level, const float* seen, std::size_t channel) const {
  const float lost_by_curve = lost_by_encoding * std::max(white_level, std::abs(level));
  if (is_float) {
    const float held = shares_exponent ? *std::max_element(seen, seen + 3) : std::abs(seen[channel]);
    return lost_by_curve + (shares_exponent ? lost * power_of_two_below(held) : lost * held);
  }
  const bool is_by_8_bits = has_upper_bits.at(channel) || reduced == Reduced::equal_parts;
  if (is_by_8_bits) return lost_by_curve + lost_by_factor;
  const auto steps = static_cast<float>(levels.at(channel) - 1);
  return lost_by_curve + (has_equal_parts ? lost_by_factor * (white_level / steps) : 0);
}

std::string OutputEncoding::depth_in_words() const {
  if (is_float) return "floats";
  const std::string how = rounds ? "rounded to " : "truncated to ";
  if (has_256_levels()) return how + "8 bits" + (has_equal_parts ? " as 256 equal parts" : "");
  if (levels == std::array{65536, 65536, 65536})
    return how + "16 bits" + (has_equal_parts ? " as 65536 equal parts" : "");
  std::string text = std::to_string(levels[0]);
  if (levels[1] != levels[0] || levels[2] != levels[0])
    text += ", " + std::to_string(levels[1]) + " and " + std::to_string(levels[2]);
  if (reduced == Reduced::no) return how + text + " levels";
  return std::string(reduced == Reduced::rounded ? "rounded" : "truncated") + " to 8 bits" +
         (reduced == Reduced::equal_parts ? " as 256 equal parts" : "") + ", then " + how + text + " levels";
}

std::string OutputEncoding::in_words() const {
  std::string words = tone_map ? "tone-mapped" : "not tone-mapped";
  if (curve != Curve::linear) words += curve == Curve::srgb ? ", sRGB curve" : ", gamma 2.2";
  return words + ", " + depth_in_words();
}

std::vector<OutputEncoding> encodings_of(const OutputEncoding& read) {
  std::vector<OutputEncoding> all;
  for (const Curve curve : {Curve::linear, Curve::gamma, Curve::srgb}) {
    for (const bool tone_map : {true, false}) {
      for (const bool rounds : {false, true}) {
        if (rounds && (read.is_float || read.has_upper_bits == std::array{true, true, true})) continue;
        OutputEncoding& one = all.emplace_back(read);
        one.tone_map = tone_map;
        one.curve = curve;
        one.rounds = rounds;
      }
    }
  }
  return all;
}

}  // namespace plumb::diagnosis
