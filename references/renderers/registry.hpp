// The renderers whose pictures are taken for right, by name.
#pragma once

#include <memory>
#include <string>

#include "references/renderers/renderer.hpp"

namespace plumb::renderers {

struct ReferenceOptions {
  std::string name{};               ///< of the renderer; empty: the first of the list
  bool stored = false;              ///< its stored images are used, and no program is started
  double time_limit_seconds = 600;  ///< for one run of the program
};

/// Returns the renderer without cache and stored images. Throws std::invalid_argument when there is no
/// renderer of that name.
std::unique_ptr<const ProgramRenderer> program_renderer(const ReferenceOptions& options);

struct Reference {
  std::unique_ptr<const Renderer> renderer;
  std::string notice;  ///< to be said loudly when stored images are used; else empty
};

/// Returns a renderer that uses the cache, or the stored images when they are asked for or the program is
/// absent.
/// Throws std::invalid_argument as above, and std::runtime_error when the program does not tell its version.
Reference reference_renderer(const ReferenceOptions& options);

}  // namespace plumb::renderers
