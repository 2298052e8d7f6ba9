#include "references/report/layer_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace plumb::report {
namespace {

using textbook::Layer;

/// The channels of one layer, a pixel at a time.
class Channels {
 public:
  Channels(const ImageFile& rendered, std::size_t first, std::size_t count)
      : values_(rendered.values),
        channels_(static_cast<std::size_t>(rendered.channels)),
        first_(first),
        count_(count) {}

  std::size_t pixels() const { return values_.size() / channels_; }
  std::span<const float> at(std::size_t pixel) const {
    return values_.subspan(channels_ * pixel + first_, count_);
  }

 private:
  std::span<const float> values_;
  std::size_t channels_, first_, count_;
};

Channels channels_of_layer(Layer layer, const ImageFile& rendered, const std::vector<Layer>& layers,
                           const Scene& scene) {
  std::size_t first = 3;
  for (const Layer other : layers) {
    if (other == layer) break;
    first += channels_of(other, scene).size();
  }
  return {rendered, first, channels_of(layer, scene).size()};
}

bool is_nothing(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return value == 0; });
}

/// The least and the largest value of one channel where something is met.
struct Extent {
  float least = std::numeric_limits<float>::infinity();
  float most = -std::numeric_limits<float>::infinity();

  float share(float value) const { return most > least ? (value - least) / (most - least) : 1; }
};

Extent extent_of(const Channels& channels, std::size_t channel) {
  Extent extent;
  for (std::size_t pixel = 0; pixel < channels.pixels(); ++pixel) {
    const auto values = channels.at(pixel);
    if (is_nothing(values)) continue;
    extent.least = std::min(extent.least, values[channel]);
    extent.most = std::max(extent.most, values[channel]);
  }
  return extent;
}

using Colour = std::array<float, 3>;

Colour grey(float value) { return {value, value, value}; }

/// Hues a golden section apart, so that neighbouring numbers differ most.
Colour hue_of(float number) {
  constexpr float golden_section = 0.618034F;
  const float turn = number * golden_section;
  Colour colour{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float phase = turn + static_cast<float>(channel) / 3;
    colour[channel] = 0.55F + 0.45F * std::cos(6.2831853F * phase);
  }
  return colour;
}

Colour shown(Layer layer, std::span<const float> v, const std::vector<Extent>& extents) {
  switch (layer) {
    case Layer::normal:
    case Layer::direction:
      return {v[0] / 2 + 0.5F, v[1] / 2 + 0.5F, v[2] / 2 + 0.5F};
    case Layer::depth:
      return grey(1 - 0.9F * extents[0].share(v[0]));
    case Layer::point:
      return {extents[0].share(v[0]), extents[1].share(v[1]), extents[2].share(v[2])};
    case Layer::object:
      return hue_of(v[0]);
    case Layer::shadow: {
      float hidden = 0;
      for (const float share : v) hidden += share;
      return grey(v.empty() ? 1 : 1 - hidden / static_cast<float>(v.size()));
    }
    case Layer::ambient:
    case Layer::diffuse:
    case Layer::specular:
    case Layer::mirror:
    case Layer::refraction:
      return {v[0], v[1], v[2]};
  }
  return {};
}

}  // namespace

Image picture_of(Layer layer, const ImageFile& rendered, const std::vector<Layer>& layers,
                 const Scene& scene) {
  const Channels channels = channels_of_layer(layer, rendered, layers, scene);
  std::vector<Extent> extents;
  if (layer == Layer::depth || layer == Layer::point) {
    for (std::size_t channel = 0; channel < channels.at(0).size(); ++channel)
      extents.push_back(extent_of(channels, channel));
  }
  Image image(rendered.width, rendered.height);
  for (std::size_t pixel = 0; pixel < channels.pixels(); ++pixel) {
    const auto values = channels.at(pixel);
    const bool is_black = layer != Layer::shadow && is_nothing(values);
    if (!is_black) std::ranges::copy(shown(layer, values, extents), image.rgb.data() + 3 * pixel);
  }
  return image;
}

Encoding encoding_of(Layer layer) {
  switch (layer) {
    case Layer::ambient:
    case Layer::diffuse:
    case Layer::specular:
    case Layer::mirror:
    case Layer::refraction:
    case Layer::object:
      return Encoding::srgb;
    default:
      return Encoding::linear;
  }
}

}  // namespace plumb::report
