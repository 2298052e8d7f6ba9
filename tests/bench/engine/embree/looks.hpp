// What surfaces look like, as arrays.
#pragma once

#include <vector>

#include "tracer/scene/scene.hpp"

namespace plumb::bench {

/// Colours and numbers of all materials and lights as arrays, ready to be gathered.
struct Looks {
  explicit Looks(const Scene& scene);

  std::vector<float> ambient[3], kd[3], ks[3], mirror[3], transmit[3], m, eta;
  std::vector<int> spawns;  ///< by material: whether it mirrors or transmits
  struct Light {
    float position[3], intensity[3];
  };
  std::vector<Light> lights;
  float background[3];
  bool has_highlights, has_glass, has_secondary;
};

}  // namespace plumb::bench
