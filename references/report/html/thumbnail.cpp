#include "references/report/html/thumbnail.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "references/report/html/packing.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::report {
namespace {

struct Range {
  int begin;
  int end;
};

/// The pixels of one side that pixel `i` of `count` covers: at least one.
Range covered(int i, int count, int size) {
  const auto edge = [&](int k) { return static_cast<int>(static_cast<long long>(k) * size / count); };
  return {edge(i), std::max(edge(i + 1), edge(i) + 1)};
}

/// Calls `visit(columns, rows)` for each pixel of the small picture, row by row; returns its samples as PNG.
template <typename Visit>
std::string small_png(const Image& image, int channels, Visit visit) {
  constexpr int most = 144;
  const double scale = std::min(1.0, static_cast<double>(most) / std::max(image.width, image.height));
  const int width = std::max(1, static_cast<int>(image.width * scale));
  const int height = std::max(1, static_cast<int>(image.height * scale));
  std::vector<unsigned char> samples;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      visit(covered(x, width, image.width), covered(y, height, image.height), samples);
    }
  }
  return png(width, height, channels, samples);
}

float mean(const Image& image, std::size_t channel, Range columns, Range rows) {
  float sum = 0;
  for (int y = rows.begin; y < rows.end; ++y) {
    for (int x = columns.begin; x < columns.end; ++x) {
      sum += std::clamp(image.pixel(x, y)[channel], 0.0F, 1.0F);
    }
  }
  return sum / static_cast<float>((columns.end - columns.begin) * (rows.end - rows.begin));
}

double error(const float* reference, const float* test) {
  double largest = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const double right = reference[channel];
    const double apart = std::abs(test[channel] - right) / std::max(1.0, std::abs(right));
    if (!std::isfinite(apart)) return 1;
    largest = std::max(largest, apart);
  }
  return largest;
}

unsigned char grey_of(double error) {
  constexpr double decades = 8;
  const double level = error > 0 ? 1 + std::log10(error) / decades : 0;
  return static_cast<unsigned char>(std::lround(255 * std::clamp(level, 0.0, 1.0)));
}

}  // namespace

std::string thumbnail(const Image& image, bool is_encoded) {
  return small_png(image, 3, [&](Range columns, Range rows, std::vector<unsigned char>& samples) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float level = mean(image, channel, columns, rows);
      samples.push_back(is_encoded ? static_cast<unsigned char>(std::lround(255 * level))
                                   : srgb_8_bits(level));
    }
  });
}

std::string error_thumbnail(const Image& reference, const Image& test) {
  return small_png(reference, 1, [&](Range columns, Range rows, std::vector<unsigned char>& samples) {
    double largest = 0;
    for (int y = rows.begin; y < rows.end; ++y) {
      for (int x = columns.begin; x < columns.end; ++x) {
        largest = std::max(largest, error(reference.pixel(x, y), test.pixel(x, y)));
      }
    }
    samples.push_back(grey_of(largest));
  });
}

}  // namespace plumb::report
