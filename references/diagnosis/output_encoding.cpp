#include "references/diagnosis/output_encoding.hpp"

#include <algorithm>
#include <cmath>

#include "tracer/image/encode.hpp"

namespace plumb::references {
namespace {

constexpr float most = 255;

float curved(float c, Curve curve) {
  if (curve == Curve::linear || !(c > 0)) return c;
  if (curve == Curve::gamma) return std::pow(c, 1 / 2.2F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
}

}  // namespace

float OutputEncoding::unrounded(float colour) const {
  return most * curved(tone_map ? tone_mapped(colour) : colour, curve);
}

float OutputEncoding::rounded(float level) const {
  if (std::isnan(level)) return 0;
  if (is_float) return level;
  return std::clamp(std::floor(rounds ? level + 0.5F : level), 0.0F, most);
}

std::string OutputEncoding::in_words() const {
  std::string words = tone_map ? "tone-mapped" : "not tone-mapped";
  if (curve != Curve::linear) words += curve == Curve::srgb ? ", sRGB curve" : ", gamma 2.2";
  if (is_bgr) words += ", red and blue exchanged";
  return words + (is_float ? ", floats" : rounds ? ", rounded to 8 bits" : ", truncated to 8 bits");
}

std::vector<OutputEncoding> encodings_of(Sample sample) {
  const bool is_float = sample != Sample::bits8;
  std::vector<OutputEncoding> all;
  for (const bool is_bgr : {false, true}) {
    for (const Curve curve : {Curve::linear, Curve::gamma, Curve::srgb}) {
      for (const bool tone_map : {true, false}) {
        for (const bool rounds : {false, true}) {
          if (rounds && is_float) continue;
          all.push_back({tone_map, curve, rounds, is_bgr, is_float});
        }
      }
    }
  }
  return all;
}

}  // namespace plumb::references
