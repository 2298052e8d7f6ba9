#include "references/diagnosis/remains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "references/diagnosis/float_noise.hpp"

namespace plumb::diagnosis {
namespace {

constexpr std::size_t channels_of_colour = 3;
/// The pixels that encodings are chosen by, evenly spread; all of most pictures.
constexpr std::size_t most_to_choose_by = 200'000;
constexpr int moves = 48;  // because an edge that shows in half of the moves is missed in none of 48
/// With more pixels than this, edges are only a part: a sample tells whether to prove each, which takes
/// seconds.
constexpr std::size_t most_without_sample = 1000;
constexpr std::size_t size_of_sample = 200;
constexpr int moves_of_sample = 8;             // because half of the edges show in the first of them
constexpr double most_units_of_remains = 6e7;  // of Work: some 1.5 s
/// because outcomes that are nearer, five levels, are of one surface, and what lies between them may be, too
constexpr float one_surface = 5.0F / 255;

/// Tells whether a file can hold a colour at a pixel.
class Holding {
 public:
  Holding(const Evidence& evidence, const OutputEncoding& encoding)
      : evidence_(evidence), encoding_(encoding) {}

  /// True if a colour between the two, or off by what float32 rounds, gives what is seen.
  bool holds(const float* low, const float* high, std::size_t pixel) const {
    for (std::size_t channel = 0; channel < channels_of_colour; ++channel) {
      if (!holds(low[channel], high[channel], pixel, channel)) return false;
    }
    return true;
  }

  /// Returns the largest difference of a channel; all levels where one is no number.
  double levels_off(const float* colour, std::size_t pixel) const {
    const float* const seen = evidence_.seen(pixel);
    float largest = 0;
    for (std::size_t channel = 0; channel < channels_of_colour; ++channel) {
      const float level = encoding_.level(colour[channel], channel);
      const float off = std::abs(level - seen[channel]);
      if (!std::isfinite(off)) return 255;
      largest = std::max(largest, off);
    }
    return largest;
  }

 private:
  bool holds(float low, float high, std::size_t pixel, std::size_t channel) const {
    const float* const seen = evidence_.seen(pixel);
    if (!std::isfinite(low) || !std::isfinite(high) || !std::isfinite(seen[channel])) return false;
    const float least = encoded(low, -1, pixel, channel);
    const float most = encoded(high, 1, pixel, channel);
    const float allowed = static_cast<float>(evidence_.allowed_levels());
    return least - allowed <= seen[channel] && seen[channel] <= most + allowed;
  }

  float encoded(float colour, float sign, std::size_t pixel, std::size_t channel) const {
    const float level = encoding_.unrounded(colour + sign * error_of(colour, pixel));
    return encoding_.rounded(level + sign * encoding_.slack(level, evidence_.seen(pixel), channel), channel);
  }

  /// Returns how far a colour may be off. A curve enlarges small errors near 0, so with a curve only what was
  /// measured counts there, or the last digits of a colour.
  float error_of(float colour, std::size_t pixel) const {
    constexpr float last_digits = 0x1p-20F;  // because a sum of some terms in float32 is exact but for these
    const float scale = std::max(1.0F, std::abs(colour));
    const float allowed = evidence_.colour_error(pixel) * scale;
    if (encoding_.curve == Curve::linear) return allowed;
    return std::min(allowed,
                    std::max(evidence_.measured_error(pixel) * scale, last_digits * std::abs(colour)));
  }

  const Evidence& evidence_;
  const OutputEncoding& encoding_;
};

/// Adds, to each encoding, the other way of truncating; and with fewer levels, the ways by 8 bits.
std::vector<OutputEncoding> all_encodings(const Evidence& evidence) {
  std::vector<OutputEncoding> all = evidence.encodings();
  for (const OutputEncoding& encoding : evidence.encodings()) {
    if (encoding.is_float || encoding.rounds || encoding.has_equal_parts) continue;
    all.push_back(encoding);
    all.back().has_equal_parts = true;
  }
  const auto& levels = all.front().levels;
  if (all.front().is_float || *std::min_element(levels.begin(), levels.end()) >= 256) return all;
  for (std::size_t i = 0, direct = all.size(); i < direct; ++i) {
    for (const Reduced reduced : {Reduced::truncated, Reduced::rounded, Reduced::equal_parts}) {
      all.push_back(all[i]);
      all.back().reduced = reduced;
    }
  }
  return all;
}

/// The cost of a pixel that is held only with float32's error: 1e9 of them do not outweigh one that is not
/// held.
constexpr double price_of_error = 1e-10;

/// Returns, over evenly spread pixels, the number that the encoding does not hold, plus a little for how far
/// they are off. Pixels that only float32's error lets it hold cost next to nothing; they tell 16 bits that
/// are rounded from truncated ones. It stops counting at `most`.
double cost_of(const Evidence& evidence, const Image& image, const OutputEncoding& encoding, double most) {
  const Holding holding(evidence, encoding);
  const std::size_t pixels = evidence.pixels_of_picture();
  const std::size_t stride = 1 + pixels / most_to_choose_by;
  const double half_a_step = 127.5 / *std::max_element(encoding.levels.begin(), encoding.levels.end());
  double cost = 0;
  for (std::size_t i = 0; i < pixels && cost < most; i += stride) {
    const float* const colour = &image.rgb[channels_of_colour * i];
    if (!holding.holds(colour, colour, i)) {
      cost += 1 + std::log1p(holding.levels_off(colour, i)) / 8;
    } else if (!encoding.is_float && holding.levels_off(colour, i) > half_a_step) {
      cost += price_of_error;
    }
  }
  return cost;
}

OutputEncoding best_encoding(const Evidence& evidence, const Image& image) {
  OutputEncoding best = evidence.encodings().front();
  double least = std::numeric_limits<double>::infinity();
  for (const OutputEncoding& encoding : all_encodings(evidence)) {
    const double cost = cost_of(evidence, image, encoding, least);
    if (cost >= least) continue;
    best = encoding;
    least = cost;
  }
  return best;
}

using Outcome = std::array<float, channels_of_colour>;

/// A pixel that is tried, and the colours that moved scenes gave it.
struct Suspect {
  std::size_t pixel;
  std::vector<Outcome> outcomes;
  std::optional<std::uint64_t> course;  ///< of its rays in the scene that is not moved
  bool is_edge = false;                 ///< its rays may take another course
  bool is_tried = false;                ///< true once outcomes were tried as a proof of an edge
  bool is_proven = false;
};

bool are_of_one_surface(const Outcome& a, const Outcome& b) {
  for (std::size_t c = 0; c < channels_of_colour; ++c) {
    const float scale = std::max({1.0F, std::abs(a[c]), std::abs(b[c])});
    if (!(std::abs(a[c] - b[c]) <= one_surface * scale)) return false;
  }
  return true;
}

/// True if both are alike but for errors. What is off by more is another surface or another light.
bool are_of_one_error(const Outcome& a, const Outcome& b) {
  for (std::size_t c = 0; c < channels_of_colour; ++c) {
    if (!(std::abs(a[c] - b[c]) <= most_of_an_error * std::max(1.0F, std::abs(b[c])))) return false;
  }
  return true;
}

class Proof {
 public:
  Proof(const Evidence& evidence, const FaultSet& set, const OutputEncoding& encoding)
      : evidence_(evidence), set_(set), holding_(evidence, encoding) {}

  /// Takes out the pixels that are proven.
  void prove(Remains& remains) const {
    std::vector<Suspect> all = suspects(remains.pixels);
    if (all.size() > most_without_sample && !is_mostly_chance(all)) return;
    try_textbook(all);
    try_moves(all, moves);
    if (set_.empty()) try_float(all);
    for (const Suspect& s : all) {
      if (!s.is_proven) continue;
      remains.pixels.erase(std::lower_bound(remains.pixels.begin(), remains.pixels.end(), s.pixel));
      remains.edges += s.is_edge ? 1 : 0;
    }
  }

 private:
  std::vector<Suspect> suspects(const std::vector<std::size_t>& pixels) const {
    std::vector<Suspect> all;
    for (const std::size_t pixel : pixels) {
      if (evidence_.is_finite(pixel)) all.push_back({pixel, {}, {}});
    }
    return all;
  }

  /// Decides by an even sample: true if most pixels are proven.
  bool is_mostly_chance(const std::vector<Suspect>& all) const {
    std::vector<Suspect> sample;
    for (std::size_t i = 0; i < size_of_sample; ++i) sample.push_back(all[i * all.size() / size_of_sample]);
    try_textbook(sample);
    try_moves(sample, moves_of_sample);
    const auto proven =
        std::count_if(sample.begin(), sample.end(), [](const Suspect& s) { return s.is_proven; });
    return 2 * static_cast<std::size_t>(proven) > size_of_sample;
  }

  /// Where the textbook tracer in float32 is off by more than the engine, other tracers may be, too.
  void try_textbook(std::vector<Suspect>& all) const {
    if (!set_.empty()) return;
    const std::vector<float> colours = evidence_.textbook_in_float(places_of(all));
    const float* const right = evidence_.picture_with({}).rgb.data();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Outcome in_float = colour_at(colours.data(), i), in_double = colour_at(right, all[i].pixel);
      Outcome low = in_float, high = in_float;
      all[i].is_edge |= !are_of_one_error(in_float, in_double);
      for (std::size_t c = 0; c < channels_of_colour && !all[i].is_edge; ++c) {
        const float error = other_tracer * std::abs(in_float[c] - in_double[c]);
        low[c] = in_double[c] - error;
        high[c] = in_double[c] + error;
      }
      all[i].is_proven = holding_.holds(low.data(), high.data(), all[i].pixel);
    }
  }

  void try_moves(std::vector<Suspect>& all, int most) const {
    textbook::Work work(most_units_of_remains);
    for (int number = 0; number < most && !work.is_over(); ++number) {
      if (std::all_of(all.begin(), all.end(), [](const Suspect& s) { return s.is_proven; })) return;
      trace(number, all, work);
    }
  }

  /// What chance decides deep in a tree of rays shows in float32 only. This renders complete pictures, so it
  /// is done when few pixels are left.
  void try_float(std::vector<Suspect>& all) const {
    constexpr int pictures = 6;
    constexpr std::ptrdiff_t few = 64;
    const float* const right = evidence_.picture_with({}).rgb.data();
    for (int number = 0; number < pictures; ++number) {
      const auto open = std::count_if(all.begin(), all.end(), [](const Suspect& s) { return !s.is_proven; });
      if (open == 0 || open > few) return;
      const Image image = evidence_.moved_in_float(number);
      for (Suspect& s : all) {
        if (s.is_proven) continue;
        const auto outcome = colour_at(image.rgb.data(), s.pixel);
        const Outcome in_double = colour_at(right, s.pixel);
        s.is_edge |=
            number == 0 ? !are_of_one_error(outcome, in_double) : !are_of_one_surface(outcome, in_double);
        add(outcome, s);
      }
    }
  }

  /// Returns the places of those that are not proven.
  std::vector<PixelPlace> places_of(const std::vector<Suspect>& all) const {
    std::vector<PixelPlace> places;
    for (const Suspect& s : all) {
      if (!s.is_proven) places.push_back(evidence_.place_of(s.pixel));
    }
    return places;
  }

  void trace(int number, std::vector<Suspect>& all, textbook::Work& work) const {
    const std::vector<PixelPlace> places = places_of(all);
    const std::vector<float> colours = evidence_.moved_colours(number, set_, places, work);
    const Courses courses = courses_of(number, places, work);
    std::size_t place = 0;
    for (Suspect& s : all) {
      if (s.is_proven) continue;
      note(courses[place], number, s);
      add(colour_at(colours.data(), place++), s);
    }
  }

  using Courses = std::vector<std::optional<std::uint64_t>>;

  /// With faults there is no record of what rays meet.
  Courses courses_of(int number, const std::vector<PixelPlace>& places, textbook::Work& work) const {
    return set_.empty() ? evidence_.moved_courses(number, places, work) : Courses(places.size());
  }

  void note(const std::optional<std::uint64_t>& course, int number, Suspect& s) const {
    if (number == 0) s.course = course;
    s.is_edge |= !set_.empty() || (course && s.course && *course != *s.course);
  }

  static Outcome colour_at(const float* colours, std::size_t place) {
    return {colours[channels_of_colour * place], colours[channels_of_colour * place + 1],
            colours[channels_of_colour * place + 2]};
  }

  void add(const Outcome& outcome, Suspect& s) const {
    s.outcomes.push_back(outcome);
    if (!s.is_edge) return;
    const std::size_t last = s.outcomes.size() - 1;
    const std::size_t first = s.is_tried ? last : 0;
    s.is_tried = true;
    for (std::size_t i = 0; i <= last && !s.is_proven; ++i) {
      for (std::size_t j = std::max(i, first); j <= last && !s.is_proven; ++j)
        s.is_proven = is_between(s.outcomes[i], s.outcomes[j], s.pixel);
    }
  }

  /// True if the pixel holds one of two outcomes or, where both are of one surface, what lies between them.
  bool is_between(const Outcome& a, const Outcome& b, std::size_t pixel) const {
    if (holding_.holds(a.data(), a.data(), pixel) || holding_.holds(b.data(), b.data(), pixel)) return true;
    if (!are_of_one_surface(a, b)) return false;
    Outcome low{}, high{};
    for (std::size_t c = 0; c < channels_of_colour; ++c) std::tie(low[c], high[c]) = std::minmax(a[c], b[c]);
    return holding_.holds(low.data(), high.data(), pixel);
  }

  const Evidence& evidence_;
  const FaultSet& set_;
  Holding holding_;
};

}  // namespace

Remains remains_of(const Evidence& evidence, const FaultSet& set) {
  const Image& image = evidence.picture_with(set);
  Remains remains;
  remains.encoding = best_encoding(evidence, image);
  const Holding holding(evidence, remains.encoding);
  for (std::size_t i = 0; i < evidence.pixels_of_picture(); ++i) {
    const float* const colour = &image.rgb[channels_of_colour * i];
    if (!holding.holds(colour, colour, i)) remains.pixels.push_back(i);
  }
  Proof(evidence, set, remains.encoding).prove(remains);
  return remains;
}

std::vector<bool> within(const Evidence& evidence, const FaultSet& set, const OutputEncoding& encoding,
                         const std::vector<PixelPlace>& places) {
  const std::vector<float> colours = evidence.colours(set, places);
  const Holding holding(evidence, encoding);
  std::vector<bool> all(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    all[i] = holding.holds(&colours[channels_of_colour * i], &colours[channels_of_colour * i],
                           evidence.index_of(places[i]));
  return all;
}

}  // namespace plumb::diagnosis
