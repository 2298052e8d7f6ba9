// The approved picture of one scene.
#pragma once

#include "references/renderers/baselines.hpp"
#include "references/renderers/renderer.hpp"

namespace plumb::references {

/// Its resolution is that of plumb, be the picture made on this machine or on another one; it is not known
/// where somebody else's renderer made it.
class BaselineRenderer : public Renderer {
 public:
  /// Both must outlive it.
  BaselineRenderer(const Baselines& baselines, const Baseline& record);

  /// Of the plumb that approved it.
  std::string version() const override { return record_.version; }

  /// The approved picture, in the size that it was approved in.
  Rendered render(const Shot& shot) const override;

 private:
  const Baselines& baselines_;
  const Baseline& record_;
};

}  // namespace plumb::references
