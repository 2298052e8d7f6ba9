#include "references/renderers/cached.hpp"

#include <utility>

namespace plumb::renderers {

CachedRenderer::CachedRenderer(std::unique_ptr<const ProgramRenderer> renderer)
    : Renderer(renderer->facts()), renderer_(std::move(renderer)), version_(cache_.version_of(*renderer_)) {}

Rendered CachedRenderer::render(const Shot& shot) const {
  const ExportedShot asked = renderer_->exported(shot);
  if (auto found = cache_.find(asked, version_)) {
    found->cpu_seconds = 0;
    found->cached = true;
    return *std::move(found);
  }
  Rendered picture = renderer_->render(shot);
  // Else it may go better next time.
  if (picture.holds == facts().holds) cache_.store(asked, version_, picture);
  return picture;
}

}  // namespace plumb::renderers
