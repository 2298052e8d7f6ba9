#include "references/attribution/pixel_tracer.hpp"

#include <utility>

namespace plumb::attribution {
namespace {

Colour rounded(const Rgbd& c) {
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
}

}  // namespace

PixelTracer::PixelTracer(Scene scene, const AttributionJob& job, const RenderOptions& options,
                         textbook::Work& work, const PerturbedFormulas& formulas)
    : scene_(std::move(scene)),
      world_(scene_, formulas),
      budget_(world_.instances(), work),
      tracer_(world_, job.shot.camera, job.shot.width, job.shot.height, options, budget_),
      recorder_(budget_),
      recording_(world_, job.shot.camera, job.shot.width, job.shot.height, options, recorder_) {
  work.spend(textbook::units_of_world<double>(scene_));
}

std::optional<Colour> PixelTracer::at(const AttributedPixel& p) const {
  world_.formulas()->begin_pixel({p.x, p.y});
  const Colour colour = rounded(tracer_.raycast(p.x, p.y));
  if (budget_.take_is_cut()) return std::nullopt;
  return colour;
}

RayNode PixelTracer::tree_of(const AttributedPixel& p) const {
  world_.formulas()->begin_pixel({p.x, p.y});
  recording_.raycast(p.x, p.y);
  return recorder_.take();
}

}  // namespace plumb::attribution
