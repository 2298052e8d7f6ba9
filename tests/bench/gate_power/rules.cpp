#include "tests/bench/gate_power/rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "references/comparison/metrics/flip.hpp"
#include "tests/bench/gate_power/yiq.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::gate_power {
namespace {

/// What idiff fails by: more than `percent` of the pixels with a component over `fail`, or one component over
/// `hard_fail` (OpenImageIO, src/idiff/idiff.cpp and ImageBufAlgo::compare). NaN is over nothing, as there.
struct IdiffLimits {
  double fail;
  double percent;
  double hard_fail;
};

template <class Value>
bool idiff_passes(const std::vector<Value>& right, const std::vector<Value>& given, double unit,
                  const IdiffLimits& limits) {
  std::size_t failing = 0;
  double largest = 0;
  for (std::size_t pixel = 0; pixel < right.size(); pixel += 3) {
    double error = 0;
    for (std::size_t c = pixel; c < pixel + 3; ++c)
      error = std::max(error, std::abs(static_cast<double>(given[c]) - static_cast<double>(right[c])) / unit);
    failing += error > limits.fail ? 1 : 0;
    largest = std::max(largest, error);
  }
  const double pixels = static_cast<double>(right.size()) / 3;
  return static_cast<double>(failing) <= limits.percent / 100 * pixels && !(largest > limits.hard_fail);
}

/// OpenImageIO, testsuite/runtest.py: failthresh = 0.004, failpercent = 0.02, hardfail = 0.012, on the files
/// that its tests write; here linear floats.
bool openimageio(const Pair& p) { return idiff_passes(p.right.rgb, p.given.rgb, 1, {0.004, 0.02, 0.012}); }

/// Blender, tests/python/modules/render_report.py: idiff -fail 0.016 -failpercent 1, on 8-bit PNG.
bool blender(const Pair& p) {
  constexpr double none = std::numeric_limits<double>::infinity();
  return idiff_passes(p.right_bytes, p.given_bytes, 255, {0.016, 1, none});
}

/// appleseed, scripts/runtestsuite/runtestsuite.py: VALUE_THRESHOLD = 2 of 255, MAX_DIFFERING_COMPONENTS = 8.
bool appleseed(const Pair& p) {
  int differing = 0;
  for (std::size_t i = 0; i < p.right_bytes.size(); ++i)
    differing += std::abs(int{p.given_bytes[i]} - int{p.right_bytes[i]}) > 2 ? 1 : 0;
  return differing <= 8;
}

ByteImage view(const Pair& p, const std::vector<std::uint8_t>& bytes) {
  return {p.right.width, p.right.height, bytes.data()};
}

/// pixelmatch, index.js: threshold 0.1, what looks like anti-aliasing is left out; no pixel may differ.
bool pixelmatch(const Pair& p) {
  return differing_pixels(view(p, p.right_bytes), view(p, p.given_bytes), 0.1, true) == 0;
}

/// odiff, README: threshold 0.1, the same difference of colours, anti-aliasing looked for only on request.
bool odiff(const Pair& p) {
  return differing_pixels(view(p, p.right_bytes), view(p, p.given_bytes), 0.1, false) == 0;
}

double mean_flip(const Pair& p) {
  const auto floats = [](const std::vector<std::uint8_t>& bytes) {
    std::vector<float> values(bytes.size());
    std::transform(bytes.begin(), bytes.end(), values.begin(),
                   [](std::uint8_t b) { return static_cast<float>(b) / 255; });
    return values;
  };
  const std::vector<float> right = floats(p.right_bytes);
  const std::vector<float> given = floats(p.given_bytes);
  return comparison::flip({p.right.width, p.right.height, 3, right.data()},
                          {p.right.width, p.right.height, 3, given.data()}, comparison::ColourSpace::srgb)
      .mean;
}

/// wgpu's examples compare with a mean FLIP of 0.005 (the strictest of them) to 0.065 (ComparisonType::Mean).
bool flip_strict(const Pair& p) { return mean_flip(p) <= 0.005; }
bool flip_usual(const Pair& p) { return mean_flip(p) <= 0.05; }

std::vector<std::uint8_t> linear_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(),
                 [](float c) { return truncated_to_8_bits(c + 0.5F / 255); });
  return bytes;
}

}  // namespace

Pair pair_of(const Image& right, const Image& given, Made made) {
  if (made == Made::bits8_rounded || made == Made::bits8_truncated)
    return {right, given, linear_bytes(right), linear_bytes(given)};
  return {right, given, encode_8_bits(right, Encoding::srgb), encode_8_bits(given, Encoding::srgb)};
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{
      {"OpenImageIO's tests", "idiff: at most 0.02 % of the pixels over 0.004, none over 0.012; float",
       &openimageio},
      {"Blender's tests", "idiff: at most 1 % of the pixels over 0.016; 8 bits", &blender},
      {"appleseed's tests", "at most 8 components over 2/255; 8 bits", &appleseed},
      {"pixelmatch", "threshold 0.1, without what looks like anti-aliasing; 8 bits", &pixelmatch},
      {"odiff", "threshold 0.1; 8 bits", &odiff},
      {"FLIP, mean 0.005", "the strictest of wgpu's examples; 8 bits", &flip_strict},
      {"FLIP, mean 0.05", "as many of wgpu's examples; 8 bits", &flip_usual},
  };
  return all;
}

}  // namespace plumb::gate_power
