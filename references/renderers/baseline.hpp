// Gives the approved picture of one scene as a renderer does.
#pragma once

#include "references/renderers/baselines.hpp"
#include "references/renderers/renderer.hpp"

namespace plumb::renderers {

/// Its resolution is that of plumb, whichever machine made the picture. It is not known when somebody else's
/// renderer made it.
class BaselineRenderer : public Renderer {
 public:
  /// Both must outlive it.
  BaselineRenderer(const Baselines& baselines, const Baseline& record);

  /// Returns the version of the plumb that approved it.
  std::string version() const override { return record_.version; }

  /// Returns the approved picture, in the size that it was approved in.
  Rendered render(const Shot& shot) const override;

 private:
  const Baselines& baselines_;
  const Baseline& record_;
};

}  // namespace plumb::renderers
