#include "references/renderers/baseline.hpp"

#include "references/renderers/ours.hpp"

namespace plumb::renderers {
namespace {

std::optional<Resolution> resolution_of(const Baseline& record) {
  return record.renderer.empty() ? std::optional(own_resolution()) : std::nullopt;
}

}  // namespace

BaselineRenderer::BaselineRenderer(const Baselines& baselines, const Baseline& record)
    : Renderer({"baseline", "the baseline", Holds::float32, resolution_of(record)}),
      baselines_(baselines),
      record_(record) {}

Rendered BaselineRenderer::render(const Shot&) const { return {baselines_.load(record_)}; }

}  // namespace plumb::renderers
