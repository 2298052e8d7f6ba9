#include "references/attribution/ray_tree.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace plumb::attribution {

bool Recorder::ray_begins(textbook::RayKind kind, const Ray<double>& ray, int depth) const {
  if (!state_->budget.ray_begins(kind, ray, depth)) {
    current().is_cut = true;
    return false;
  }
  RayNode& node = state_->open.emplace_back();
  node.kind = kind;
  node.ray = ray;
  node.depth = depth;
  return true;
}

void Recorder::is_black_at_depth_limit() const { current().is_at_depth_limit = true; }

void Recorder::meets(const textbook::Hit<double>& hit, const textbook::Surface<double>& surface,
                     const Vec3d& point, const Vec3d& normal) const {
  current().meeting = Meeting{hit.surface, surface.shape, hit.t, point, normal, {}};
}

void Recorder::is_lit_by(std::size_t light, const textbook::LightSeen<double>& seen) const {
  state_->budget.is_lit_by(light, seen);
  current().meeting->lights.push_back(seen);
}

void Recorder::ray_ends(const Rgbd& colour) const {
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
  state_->budget.take_is_cut();
  return std::exchange(state_->finished, {});
}

bool is_cut(const RayNode& tree) {
  return tree.is_cut || std::any_of(tree.children.begin(), tree.children.end(), &is_cut);
}

std::uint64_t course_of(const RayNode& tree) {
  std::uint64_t course = 0;
  // Knuth's factor for 64 bits (MMIX), so that every number counts at its place.
  const auto add = [&](std::uint64_t number) {
    course = (course ^ number) * 6364136223846793005U + 1442695040888963407U;
  };
  add(static_cast<std::uint64_t>(tree.kind));
  add(tree.is_at_depth_limit ? 1 : 0);
  if (tree.meeting) {
    add(tree.meeting->surface.instance);
    add(static_cast<std::uint64_t>(tree.meeting->surface.face));
    for (const auto& light : tree.meeting->lights) {
      add(light.counts ? 1 : 0);
      for (int c = 0; c < 3; ++c) add(std::bit_cast<std::uint32_t>(static_cast<float>(light.delta[c])));
    }
  }
  for (const RayNode& child : tree.children) add(course_of(child));
  return course;
}

TreeTracer::TreeTracer(const Shot& shot) : TreeTracer(shot, unlimited_) {}

TreeTracer::TreeTracer(const Shot& shot, textbook::Work& work)
    : world_(shot.scene, Formulas({})),
      recorder_(textbook::RayBudget<double>(world_.instances(), work)),
      tracer_(world_, shot.camera, shot.width, shot.height, shot.options, recorder_) {}

RayNode TreeTracer::tree_of(int x, int y) const {
  tracer_.raycast(x, y);
  return recorder_.take();
}

}  // namespace plumb::attribution
