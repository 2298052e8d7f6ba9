// Which rows of the lecture a scene has, and which of them its picture shows.
#pragma once

#include <string>
#include <vector>

#include "references/studies/needs/observed.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::references {

/// A row of LECTURE.md, or a part of one.
struct Feature {
  std::string id;     ///< lower case, words joined by -
  std::string slide;  ///< as LECTURE.md has it
  std::string what;
  std::size_t in_scene = 0;  ///< so many things of the scene ask for it
  std::string things;        ///< what is counted there, one of them
  std::uint64_t seen = 0;    ///< so often it happened in the pixels that were looked at
  std::string times;         ///< what is counted there
};

/// All, in the order of the lecture, those that a scene has none of included.
std::vector<Feature> features_of(const Scene& scene, const Camera& camera, const RenderOptions& options,
                                 const Observed& observed);

}  // namespace plumb::references
