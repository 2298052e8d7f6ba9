// What a report shows of a scene besides its figures.
#pragma once

#include <memory>
#include <optional>

#include "references/attribution/attribution.hpp"
#include "tracer/image/image.hpp"

namespace plumb::gates {

struct Pictures {
  /// What the rays of the scene can be traced with.
  struct Traced {
    Scene scene;
    Camera camera;
    RenderOptions options;
  };

  std::shared_ptr<const Image> reference;
  std::shared_ptr<const Image> ours;
  std::optional<Traced> traced;  ///< nothing where somebody else's renderer made the picture
};

/// Copies of what the job has.
std::shared_ptr<const Pictures> pictures_of(const attribution::AttributionJob& job);

}  // namespace plumb::gates
