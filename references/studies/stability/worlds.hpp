// Small scenes, each under one condition, for renderers that make complete pictures.
#pragma once

#include <optional>
#include <string>

#include "tracer/scene/scene.hpp"

namespace plumb::studies::stability {

struct World {
  Scene scene;
  Camera camera;
  int depth = 8;  ///< greatest number of reflections
};

/// Returns a picture all of which is under the condition; nothing where a condition is one of single rays.
std::optional<World> world_of(const std::string& condition, double value);

/// Returns where the rays of such a condition are seen: an edge or a silhouette from nearby. Nothing where no
/// picture shows it, or not at that value.
std::optional<World> close_up_of(const std::string& condition, double value);

}  // namespace plumb::studies::stability
