#include "references/ray_tree.hpp"

#include <utility>

#include "tracer/textbook/tracer.hpp"

namespace plumb::references {

void Recorder::ray_begins(textbook::RayKind kind, const Ray<double>& ray, int depth) const {
  if (state_->left_out > 0 || state_->rays == most_rays) {
    ++state_->left_out;
    current().is_cut = true;
    return;
  }
  ++state_->rays;
  RayNode& node = state_->open.emplace_back();
  node.kind = kind;
  node.ray = ray;
  node.depth = depth;
}

void Recorder::is_black_at_depth_limit() const {
  if (state_->left_out == 0) current().is_at_depth_limit = true;
}

void Recorder::meets(const textbook::Hit<double>& hit, const textbook::Surface<double>& surface,
                     const Vec3d& point, const Vec3d& normal) const {
  if (state_->left_out > 0) return;
  current().meeting = Meeting{hit.surface, surface.shape, hit.t, point, normal, {}};
}

void Recorder::is_lit_by(std::size_t, const textbook::LightSeen<double>& seen) const {
  if (state_->left_out == 0) current().meeting->lights.push_back(seen);
}

void Recorder::ray_ends(const Rgbd& colour) const {
  if (state_->left_out > 0) {
    --state_->left_out;
    return;
  }
  RayNode node = std::move(current());
  state_->open.pop_back();
  node.colour = colour;
  if (state_->open.empty()) {
    state_->finished = std::move(node);
  } else {
    current().children.push_back(std::move(node));
  }
}

RayNode Recorder::take() const {
  state_->rays = 0;
  return std::exchange(state_->finished, {});
}

RayNode ray_tree(const Scene& scene, const Camera& camera, int width, int height,
                 const RenderOptions& options, int x, int y, const textbook::FormulaTable<double>& formulas) {
  const textbook::World<double> world(scene, formulas);
  const Recorder recorder;
  const textbook::Tracer<double, textbook::ReplaceableFormulas<double>, Recorder> tracer(
      world, camera, width, height, options, recorder);
  tracer.raycast(x, y);
  return recorder.take();
}

}  // namespace plumb::references
