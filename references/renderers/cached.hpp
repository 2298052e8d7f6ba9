// Renders each picture of a program once, and keeps it.
#pragma once

#include <memory>
#include <string>

#include "references/renderers/cache.hpp"
#include "references/renderers/renderer.hpp"

namespace plumb::renderers {

class CachedRenderer : public Renderer {
 public:
  /// Throws std::runtime_error when the program is not there or does not tell its version.
  explicit CachedRenderer(std::unique_ptr<const ProgramRenderer> renderer);

  std::string version() const override { return version_; }
  Rendered render(const Shot& shot) const override;
  std::string complaint() const override { return cache_.complaint(facts().title); }

 private:
  std::unique_ptr<const ProgramRenderer> renderer_;
  Cache cache_;
  std::string version_;
};

}  // namespace plumb::renderers
