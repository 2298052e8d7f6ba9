#include "tests/bench/engine/embree/looks.hpp"

namespace plumb::bench {
namespace {

void append_colour(const Rgbd& colour, std::vector<float> (&to)[3]) {
  for (int c = 0; c < 3; ++c) to[c].push_back(static_cast<float>(colour[c]));
}

}  // namespace

Looks::Looks(const Scene& scene) : has_highlights(false), has_glass(false), has_secondary(false) {
  for (const Material& material : scene.materials) {
    append_colour(scene.ambient * material.ka, ambient);
    append_colour(material.kd, kd);
    append_colour(material.ks, ks);
    append_colour(material.mirror, mirror);
    append_colour(material.transmit, transmit);
    m.push_back(static_cast<float>(material.m));
    eta.push_back(static_cast<float>(material.eta));
    spawns.push_back(material.mirrors() || material.transmits() ? 1 : 0);
    has_highlights = has_highlights || material.ks != Rgbd(0);
    has_glass = has_glass || material.transmits();
    has_secondary = has_secondary || spawns.back() != 0;
  }
  for (const plumb::Light& from : scene.lights) {
    Light& to = lights.emplace_back();
    for (int c = 0; c < 3; ++c) {
      to.position[c] = static_cast<float>(from.position[c]);
      to.intensity[c] = static_cast<float>(from.intensity()[c]);
    }
  }
  for (int c = 0; c < 3; ++c) background[c] = static_cast<float>(scene.background[c]);
}

}  // namespace plumb::bench
