// Tells which rows of the lecture a scene has, and which of them its picture shows.
#pragma once

#include <string>
#include <vector>

#include "references/studies/needs/observed.hpp"
#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::studies {

/// A row of LECTURE.md, or a part of one.
struct Feature {
  std::string id;     ///< lower case, words joined by -
  std::string slide;  ///< as LECTURE.md has it
  std::string what;
  std::size_t in_scene = 0;  ///< number of things in the scene that ask for it
  std::string things;        ///< one of what is counted there
  std::uint64_t seen = 0;    ///< number of times that it happened in the pixels looked at
  std::string times;         ///< one of what is counted there
};

/// Returns all, in the order of the lecture, also those that the scene does not have.
std::vector<Feature> features_of(const Scene& scene, const Camera& camera, const RenderOptions& options,
                                 const Observed& observed);

}  // namespace plumb::studies
