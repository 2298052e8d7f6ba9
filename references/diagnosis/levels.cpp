#include "references/diagnosis/levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace plumb::diagnosis {
namespace {

constexpr float largest_byte = 255;
constexpr int colour_channels = 3;
constexpr int all_levels = 256;
/// The fewest levels that are looked for, because formats for the screen have at least 5 bits; a picture of
/// fewer levels is seen to be wrong.
constexpr int fewest_levels = 32;

using Values = std::set<float>;

bool are_whole(const Values& values) {
  return std::all_of(values.begin(), values.end(),
                     [](float v) { return std::abs(v - std::round(v)) < 1e-3F; });
}

/// How coarse levels are spread over those of 8 bits: by rounding, by truncation, as the upper bits, or as
/// upper bits that are repeated in the lower ones, so that white stays white.
enum class Spreading { exact, rounded, truncated, upper_bits, repeated_bits };
constexpr std::array all_spreadings{Spreading::exact, Spreading::rounded, Spreading::truncated,
                                    Spreading::upper_bits, Spreading::repeated_bits};

bool are_bits(Spreading spreading) {
  return spreading == Spreading::upper_bits || spreading == Spreading::repeated_bits;
}

float value_of(int step, int count, Spreading spreading) {
  const float exact = largest_byte * static_cast<float>(step) / static_cast<float>(count - 1);
  if (spreading == Spreading::rounded) return std::floor(exact + 0.5F);
  if (spreading == Spreading::truncated) return std::floor(exact);
  if (spreading == Spreading::exact) return exact;
  const int upper = step * (all_levels / count);
  return static_cast<float>(spreading == Spreading::upper_bits ? upper : upper + upper / count);
}

/// Returns the step that a value stands for, if it does for one.
std::optional<int> step_of(float value, int count, Spreading spreading) {
  const int guess = static_cast<int>(value / largest_byte * static_cast<float>(count - 1));
  for (const int step : {guess - 1, guess, guess + 1, guess + 2}) {
    if (step >= 0 && step < count && std::abs(value_of(step, count, spreading) - value) < 0.01F) return step;
  }
  return std::nullopt;
}

struct Coarse {
  int count = all_levels;
  Spreading spreading = Spreading::exact;
};

bool holds_all(const Values& values, int count, Spreading spreading) {
  return std::all_of(values.begin(), values.end(),
                     [&](float v) { return step_of(v, count, spreading).has_value(); });
}

/// Returns how likely it is that unrelated values lie on these levels. Values that are not whole lie on a
/// level up to 0.01 of 255; whole ones may lie on any of 256. There are four ways of spreading.
double by_chance(int count, bool is_whole, double values) {
  const double covered = is_whole ? count / 256.0 : 0.02 * count / largest_byte;
  return 4 * all_levels * std::pow(covered, values);
}

/// Returns the fewest levels that hold all values, unless there are so few different values that chance does
/// it.
std::optional<Coarse> coarse_levels(const Values& values) {
  const bool is_whole = are_whole(values);
  const auto inner = static_cast<double>(values.size()) - static_cast<double>(values.count(0)) -
                     static_cast<double>(values.count(largest_byte));
  for (int count = fewest_levels; count < all_levels; ++count) {
    if (by_chance(count, is_whole, inner) > 1e-6) return std::nullopt;  // as it is for more levels
    for (const Spreading spreading : all_spreadings) {
      if ((spreading == Spreading::exact) == is_whole) continue;
      if (are_bits(spreading) && all_levels % count != 0) continue;
      if (holds_all(values, count, spreading)) return Coarse{count, spreading};
    }
  }
  return std::nullopt;
}

Values values_of(const std::vector<float>& all, std::size_t first, std::size_t stride) {
  Values values;
  for (std::size_t i = first; i < all.size(); i += stride) values.insert(all[i]);
  return values;
}

/// Of each channel by itself, or where it has too few values, of all together.
std::array<Coarse, colour_channels> coarse_channels(const std::vector<float>& all) {
  const Coarse together = coarse_levels(values_of(all, 0, 1)).value_or(Coarse{});
  std::array<Coarse, colour_channels> found;
  for (std::size_t c = 0; c < colour_channels; ++c)
    found.at(c) = coarse_levels(values_of(all, c, colour_channels)).value_or(together);
  return found;
}

void put_on_coarse_levels(SeenLevels& seen) {
  const std::array<Coarse, colour_channels> coarse = coarse_channels(seen.values);
  for (std::size_t i = 0; i < seen.values.size(); ++i) {
    const Coarse& of = coarse.at(i % colour_channels);
    seen.read.levels.at(i % colour_channels) = of.count;
    seen.read.has_upper_bits.at(i % colour_channels) = are_bits(of.spreading);
    if (of.count == all_levels) continue;
    const int step = step_of(seen.values[i], of.count, of.spreading).value_or(0);
    seen.values[i] = value_of(step, of.count, Spreading::exact);
  }
}

bool is_finite(const float* pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]);
}

/// True if the three components have 8 bits each and the exponent of the largest, as Radiance keeps them.
/// Some readers return the middle of a step.
bool has_shared_exponent(const float* pixel) {
  const float largest = *std::max_element(pixel, pixel + colour_channels);
  if (!is_finite(pixel) || largest < 0) return false;
  int exponent = 0;
  std::frexp(largest / largest_byte, &exponent);
  for (int c = 0; c < colour_channels; ++c) {
    const float steps = std::ldexp(pixel[c] / largest_byte, 9 - exponent);
    if (std::abs(steps - std::round(steps)) > 1e-3F) return false;
  }
  return true;
}

bool all_share_exponents(const std::vector<float>& all) {
  constexpr std::size_t enough = 64;  // different values, which are on such steps by chance once in 2^1000
  for (std::size_t i = 0; i < all.size(); i += colour_channels) {
    if (!has_shared_exponent(&all[i])) return false;
  }
  return values_of(all, 0, 1).size() >= enough;
}

void learn_floats(Sample sample, SeenLevels& seen) {
  seen.read.is_float = true;
  if (sample == Sample::half) seen.read.lost = 0x1p-11F;  // half a unit in the last place
  if (sample != Sample::float32 || !all_share_exponents(seen.values)) return;
  seen.read.shares_exponent = true;
  seen.read.lost = 0x1p-7F;  // a whole step, where the largest has the fewest
}

void learn_integers(Sample sample, SeenLevels& seen) {
  if (sample == Sample::bits16 && !are_whole(values_of(seen.values, 0, 1))) {
    constexpr float steps = 65535;
    seen.read.levels.fill(65536);
    // As OutputEncoding::rounded() computes them, to the last bit.
    for (float& value : seen.values) value = largest_byte * std::round(value / largest_byte * steps) / steps;
    return;
  }
  for (float& value : seen.values) {
    if (std::abs(value - std::round(value)) < 1e-3F) value = std::round(value);
  }
  put_on_coarse_levels(seen);
}

/// True if a channel that is no colour says how colours are seen: alpha does, a depth does not.
bool is_of_the_colours(const ImageFile& seen, std::size_t channel) {
  const std::vector<std::string>& names = seen.contents.channels;
  return names.size() <= channel || names[channel] == "A";
}

/// A pixel with an alpha that is no number has no colour.
void spread_what_is_no_number(const ImageFile& seen, std::vector<float>& colours) {
  const auto of_file = static_cast<std::size_t>(seen.channels);
  for (std::size_t i = 0; i < colours.size() / colour_channels; ++i) {
    for (std::size_t c = 1; c < of_file; ++c) {
      if (!std::isfinite(seen.values[of_file * i + c]) && is_of_the_colours(seen, c))
        colours[colour_channels * i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
}

}  // namespace

SeenLevels seen_levels(const ImageFile& seen) {
  SeenLevels found;
  const auto of_file = static_cast<std::size_t>(seen.channels);
  const std::size_t pixels = of_file == 0 ? 0 : seen.values.size() / of_file;
  found.values.resize(colour_channels * pixels);
  for (std::size_t i = 0; i < found.values.size(); ++i)
    found.values[i] =
        largest_byte *
        seen.values[of_file * (i / colour_channels) + (of_file < colour_channels ? 0 : i % colour_channels)];
  spread_what_is_no_number(seen, found.values);
  if (seen.sample == Sample::bits8 || seen.sample == Sample::bits16)
    learn_integers(seen.sample, found);
  else
    learn_floats(seen.sample, found);
  return found;
}

}  // namespace plumb::diagnosis
