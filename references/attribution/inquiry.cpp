#include "references/attribution/inquiry.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::attribution {

Inquiry::Inquiry(const AttributionJob& job)
    : job_(job),
      scene_(with_instances_apart(job.shot.scene)),
      perturbation_(scene_, job.shot.camera, job.resolution),
      work_(job.work),
      still_(scene_, job, job.shot.options, work_) {}

bool Inquiry::is_finite(const AttributedPixel& p) const {
  const auto are_finite = [](const float* pixel) {
    return std::all_of(pixel, pixel + 3, [](float v) { return std::isfinite(v); });
  };
  return are_finite(reference(p)) && are_finite(test(p));
}

std::shared_ptr<const PixelTracer> Inquiry::moved_by(int pattern) const {
  constexpr std::size_t most_shapes = 100'000;  // some 50 MB
  for (const auto& [of, tracer] : moved_) {
    if (of == pattern) return tracer;
  }
  const std::size_t most =
      std::clamp<std::size_t>(most_shapes / (1 + scene_.shapes.size()), 2, usual_patterns);
  if (moved_.size() >= most) moved_.pop_front();
  moved_.emplace_back(
      pattern, std::make_shared<const PixelTracer>(perturbation_.moved(pattern), job_, job_.shot.options,
                                                   work_, perturbation_.formulas(pattern)));
  return moved_.back().second;
}

RayNode Inquiry::tree(int pattern, const AttributedPixel& p) const {
  return pattern == no_pattern ? still_.tree_of(p) : moved_by(pattern)->tree_of(p);
}

}  // namespace plumb::attribution
