#include "references/attribution/pixel_tracer.hpp"

#include <utility>

namespace plumb::references {
namespace {

/// Beside the spheres and boxes that it is held against: what a ray, a light and a shape cost as such.
constexpr double units_of_shading = 20;
constexpr double units_of_shape = 50;

Colour rounded(const Rgbd& c) {
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
}

}  // namespace

double cost_of_ray(textbook::InstanceId instances) {
  return units_of_shading + static_cast<double>(instances);
}

RayLimit::RayLimit(double units_of_ray, Work& work)
    : units_of_ray_(units_of_ray), work_(&work), rays_(std::make_shared<std::size_t>(0)) {}

bool RayLimit::ray_begins(textbook::RayKind, const Ray<double>&, int) const {
  work_->spend(units_of_ray_);
  return ++*rays_ <= most_rays_of_pixel;
}

void RayLimit::is_lit_by(std::size_t, const textbook::LightSeen<double>& seen) const {
  if (seen.counts) work_->spend(units_of_ray_);
}

bool RayLimit::take_is_cut() const { return std::exchange(*rays_, 0) > most_rays_of_pixel; }

PixelTracer::PixelTracer(Scene scene, const AttributionJob& job, const RenderOptions& options, Work& work,
                         const textbook::FormulaTable<double>& formulas)
    : scene_(std::move(scene)),
      world_(scene_, formulas),
      work_(work),
      units_of_ray_(cost_of_ray(world_.instances())),
      limit_(units_of_ray_, work),
      tracer_(world_, job.shot.camera, job.shot.width, job.shot.height, options, limit_),
      recording_(world_, job.shot.camera, job.shot.width, job.shot.height, options, recorder_) {
  work.spend(units_of_shape * static_cast<double>(scene_.shapes.size()));
}

std::optional<Colour> PixelTracer::at(const AttributedPixel& p) const {
  const Colour colour = rounded(tracer_.raycast(p.x, p.y));
  if (limit_.take_is_cut()) return std::nullopt;
  return colour;
}

RayNode PixelTracer::tree_of(const AttributedPixel& p) const {
  recording_.raycast(p.x, p.y);
  RayNode tree = recorder_.take();
  work_.spend(units_of_ray_ * static_cast<double>(rays_of(tree)) *
              static_cast<double>(1 + scene_.lights.size()));
  return tree;
}

}  // namespace plumb::references
