// The ways in which a chart has a picture made.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "references/renderers/renderer.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::studies {

/// What a picture is held against.
enum class Truth {
  pixel_centres,  ///< the textbook tracer in 113 bits: one exact sample through each pixel's centre
  pixel_areas     ///< the mean over the pixel's area, of very many samples
};

/// One way. Its strings say how; an empty one is null in JSON.
struct Configuration {
  std::string id;     ///< unique, made of a-z 0-9 and -
  std::string work;   ///< the same for those that do the same and differ in the truth only: it is timed once
  std::string title;  ///< for a reader
  std::string real;
  std::string methods;
  std::optional<bool> hierarchy;
  int samples = 1;  ///< of a pixel at most: POV-Ray takes more only where neighbours differ
  Truth truth = Truth::pixel_centres;
  std::shared_ptr<const renderers::Renderer> renderer;  ///< in one thread
  bool is_program = false;                              ///< its start costs something, and is no rendering
};

/// Above this number of objects, the engine renders nothing without a hierarchy.
inline constexpr std::uint64_t most_without_hierarchy = 1000;

/// The unit of costs: it is measured beside every other configuration, in the same minute.
Configuration yardstick();

/// All ways to render this scene that make sense; POV-Ray's when there is one.
std::vector<Configuration> configurations(const Scene& scene, bool has_povray);

/// What was left out of configurations() for this scene, and why; empty when nothing.
std::vector<std::string> left_out(const Scene& scene, bool has_povray);

}  // namespace plumb::studies
