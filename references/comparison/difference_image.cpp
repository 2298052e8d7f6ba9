#include "references/comparison/difference_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tracer/image/format.hpp"
#include "tracer/image/image_writer.hpp"

namespace plumb::comparison {
namespace {

/// Computes the differences of one row after the other.
class Differences {
 public:
  Differences(const PixelRows& reference, const PixelRows& test, const PixelMask& mask)
      : reference_(reference),
        test_(test),
        mask_(mask),
        r_(reference.row_values()),
        t_(reference.row_values()) {}

  void row(int y, float* out) {
    reference_.copy_row(y, r_.data());
    test_.copy_row(y, t_.data());
    const auto channels = static_cast<std::size_t>(reference_.channels);
    for (int x = 0; x < reference_.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = static_cast<std::size_t>(x) * channels + (channels < 3 ? 0 : c);
        *out++ = mask_.has(x, y) ? difference(r_[at], t_[at]) : 0.0F;
      }
    }
  }

 private:
  static float difference(double r, double t) {
    if (!std::isfinite(r) || !std::isfinite(t)) return std::numeric_limits<float>::quiet_NaN();
    return static_cast<float>(std::abs(t - r));
  }

  const PixelRows& reference_;
  const PixelRows& test_;
  const PixelMask& mask_;
  std::vector<double> r_;
  std::vector<double> t_;
};

/// Scales a row. What is not finite becomes magenta, which no difference of greys is.
void scale_row(float* row, std::size_t values, double scale) {
  for (std::size_t i = 0; i < values; i += 3) {
    if (std::all_of(row + i, row + i + 3, [](float v) { return std::isfinite(v); })) {
      for (std::size_t c = i; c < i + 3; ++c) row[c] = static_cast<float>(row[c] * scale);
    } else {
      row[i] = row[i + 2] = 1;
      row[i + 1] = 0;
    }
  }
}

}  // namespace

DifferenceImage write_difference(const std::string& path, const PixelRows& reference, const PixelRows& test,
                                 const PixelMask& mask) {
  const Encoding encoding = default_encoding(path);
  if (const auto complaint = complaint_about(path, encoding)) throw std::invalid_argument(*complaint);
  Differences differences(reference, test, mask);
  DifferenceImage result;
  result.is_float = is_float_format(extension_of(path));
  result.leaves_out_channels = reference.channels > 3 || reference.channels == 2;
  Image band(reference.width, 1);
  float largest = 0;
  for (int y = 0; y < reference.height; ++y) {
    differences.row(y, band.rgb.data());
    for (const float v : band.rgb) {
      result.has_non_finite = result.has_non_finite || std::isnan(v);
      if (std::isfinite(v)) largest = std::max(largest, v);
    }
  }
  if (!result.is_float && largest > 0) result.scale = 1 / static_cast<double>(largest);
  ImageWriter writer(path, reference.width, reference.height, encoding);
  for (int y = 0; y < reference.height; ++y) {
    differences.row(y, band.rgb.data());
    if (!result.is_float) scale_row(band.rgb.data(), band.rgb.size(), result.scale);
    writer.write(band);
  }
  writer.finish();
  return result;
}

}  // namespace plumb::comparison
