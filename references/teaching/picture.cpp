#include "references/teaching/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "references/report/html/packing.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::teaching {
namespace {

unsigned char byte_of(float level) {
  return std::isnan(level) ? 0 : static_cast<unsigned char>(std::clamp(level, 0.0F, 255.0F));
}

}  // namespace

Picture picture_of(const Image& image) {
  return {image.width, image.height, encode_8_bits(image, Encoding::course)};
}

Picture picture_of(const ImageFile& image) {
  Picture picture{image.width, image.height, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i + channels <= image.values.size(); i += channels) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.levels.push_back(byte_of(255 * image.values[i + (channels < 3 ? 0 : c)] + 0.5F));
  }
  return picture;
}

Picture picture_of(const Image& image, const diagnosis::OutputEncoding& encoding) {
  Picture picture{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    picture.levels.push_back(byte_of(encoding.level(image.rgb[i], i % 3) + 0.5F));
  return picture;
}

Picture difference_of(const Picture& a, const Picture& b) {
  Picture difference{a.width, a.height, {}};
  for (std::size_t i = 0; i < a.levels.size(); ++i)
    difference.levels.push_back(static_cast<unsigned char>(
        std::min(255, report::html::difference_gain * std::abs(int{a.levels[i]} - int{b.levels[i]}))));
  return difference;
}

report::html::ThreePictures three_pictures(const Picture& right, const Picture& yours) {
  const auto packed = [](const Picture& p) {
    return report::base64(report::png(p.width, p.height, 3, p.levels));
  };
  return {packed(right), packed(yours), packed(difference_of(right, yours))};
}

}  // namespace plumb::teaching
