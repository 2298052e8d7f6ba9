#include "exporters/povray_material.hpp"

#include <vector>

#include "tracer/text/numbers.hpp"

namespace plumb::exporters {
namespace {

/// Stands for a coefficient of 0 that is divided by. It is so small that it changes no float32 of a picture.
constexpr double least_tint = 0x1p-60;

std::string sdl_with(const Rgbd& colour, double fourth) {
  return "<" + to_text(colour.x) + "," + to_text(colour.y) + "," + to_text(colour.z) + "," + to_text(fourth) +
         ">";
}

bool is_grey(const Rgbd& c) { return c.x == c.y && c.y == c.z; }

struct Layer {
  std::string pigment;
  std::string finish;
};

/// Collects layers from the top down. What lies beneath a layer is multiplied by its filter; `beneath_` is
/// the product of these so far and every colour is divided by it.
class Layers {
 public:
  /// Adds a layer that shines by itself (`finish` says how) with `colour`. It is half opaque if another
  /// follows.
  void add_shining(const Rgbd& colour, const std::string& finish, bool is_last) {
    if (is_last) {
      layers_.push_back({"rgb " + sdl(colour / beneath_), finish});
    } else {
      layers_.push_back({"rgbt " + sdl_with(2.0 / beneath_ * colour, 0.5), finish});
      beneath_ *= 0.5;
    }
  }
  void add_filter(const Rgbd& filter, const std::string& finish) {
    layers_.push_back({"rgbf " + sdl_with(filter, 1), finish});
  }
  double beneath() const { return beneath_; }

  /// Highlights and reflection are not scaled by the opacity of the top layer that carries them.
  std::string text(const std::string& finish_on_top) const {
    std::string text;
    for (std::size_t i = layers_.size(); i-- > 0;) {
      text += "  texture { pigment { " + layers_[i].pigment + " } finish { ambient 0 " + layers_[i].finish +
              (i == 0 ? finish_on_top : "") + " } }\n";
    }
    return text;
  }

 private:
  std::vector<Layer> layers_;
  double beneath_ = 1;
};

}  // namespace

std::string sdl(const Vec3d& v) { return "<" + to_text(v.x) + "," + to_text(v.y) + "," + to_text(v.z) + ">"; }

std::string povray_texture(const Material& material, const Rgbd& ambient) {
  const Rgbd glow = ambient * material.ka;
  const bool shines = material.ks != Rgbd(0);
  const bool coloured_highlight = shines && !is_grey(material.ks);
  const bool opaque = !material.transmits();
  const bool diffuse = material.kd != Rgbd(0);
  const std::string size = " phong_size " + to_text(material.m);
  const std::string black = "diffuse 0";

  Layers layers;
  const bool ends_opaque = opaque && !coloured_highlight;
  if (glow != Rgbd(0) || (ends_opaque && !diffuse)) {
    layers.add_shining(glow, glow == Rgbd(0) ? black : black + " emission 1", ends_opaque && !diffuse);
  }
  if (diffuse) layers.add_shining(material.kd, "diffuse 1", ends_opaque);
  if (opaque && coloured_highlight) {
    layers.add_filter(material.ks / layers.beneath(), black);
    layers.add_shining(Rgbd(0), black + " phong 1" + size, true);
  } else if (!opaque && coloured_highlight) {
    const Rgbd tint = glm::max(material.ks, Rgbd(least_tint));
    layers.add_filter(tint / layers.beneath(), black);
    layers.add_filter(material.transmit / tint, black + " phong 1" + size);
  } else if (!opaque) {
    layers.add_filter(material.transmit / layers.beneath(), black);
  }
  std::string on_top;
  if (shines && !coloured_highlight) on_top += " phong " + to_text(material.ks.x) + size;
  if (material.mirrors()) on_top += " reflection { rgb " + sdl(material.mirror) + " }";
  return layers.text(on_top);
}

}  // namespace plumb::exporters
