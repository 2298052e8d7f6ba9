#include "references/attribution/divergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::attribution {
namespace {

using textbook::LightSeen;
using textbook::no_instance;
using textbook::SurfaceId;

bool is_seen(const LightSeen<double>& light) { return light.counts && light.delta != Rgbd(0); }

class Divergence {
 public:
  Divergence(double extent, const renderers::Resolution& resolution)
      : one_place_(resolution.one_place * extent),
        told_apart_(resolution.told_apart * extent),
        shadow_(resolution.shadow * extent) {}

  /// `start` is the surface that both rays start on.
  std::optional<Cause> first(const RayNode& a, const RayNode& b, SurfaceId start) const {
    if (a.is_at_depth_limit != b.is_at_depth_limit) return Cause::depth;
    if (surface(a) != surface(b)) return other_hit(a, b, start);
    if (!a.meeting) return {};
    if (const auto cause = other_light(a, b)) return cause;
    if (!have_same_kinds(a, b)) return Cause::secondary_edge;  // at the critical angle
    for (std::size_t i = 0; i < a.children.size(); ++i) {
      if (const auto cause = first(a.children[i], b.children[i], surface(a))) return cause;
    }
    return {};
  }

 private:
  static SurfaceId surface(const RayNode& node) { return node.meeting ? node.meeting->surface : SurfaceId{}; }

  Cause edge(const RayNode& node, Cause of_camera_ray) const {
    return node.kind == textbook::RayKind::camera ? of_camera_ray : Cause::secondary_edge;
  }

  Cause other_hit(const RayNode& a, const RayNode& b, SurfaceId start) const {
    const auto t = [](const RayNode& n) {
      return n.meeting ? n.meeting->t : std::numeric_limits<double>::infinity();
    };
    const RayNode& nearer = t(a) < t(b) ? a : b;
    const bool are_two = surface(a).instance != surface(b).instance;
    if (std::abs(t(a) - t(b)) <= one_place_ && are_two) return Cause::coincident;
    if (t(nearer) <= one_place_ && a.kind != textbook::RayKind::camera) {
      return surface(nearer).instance == start.instance ? Cause::reference_tolerance : Cause::coincident;
    }
    return edge(a, Cause::silhouette);
  }

  std::optional<Cause> other_light(const RayNode& a, const RayNode& b) const {
    const auto& seen = a.meeting->lights;
    const auto& other = b.meeting->lights;
    for (std::size_t i = 0; i < std::min(seen.size(), other.size()); ++i) {
      if (seen[i].counts == other[i].counts && seen[i].delta == other[i].delta) continue;
      return hidden_by(is_seen(seen[i]) ? other[i] : seen[i], a);
    }
    return {};
  }

  /// What it means that one of the two does not see the light.
  Cause hidden_by(const LightSeen<double>& hidden, const RayNode& node) const {
    const double from_point = hidden.blocker.t;
    const double from_light = std::abs(hidden.distance - hidden.blocker.t);
    const double nearest = std::min(from_point, from_light);
    if (!hidden.counts || hidden.blocker.surface.instance == no_instance || nearest > shadow_)
      return edge(node, Cause::shadow_edge);
    const bool is_other = hidden.blocker.surface.instance != surface(node).instance;
    return is_other && from_point <= told_apart_ ? Cause::coincident : Cause::reference_tolerance;
  }

  static bool have_same_kinds(const RayNode& a, const RayNode& b) {
    return std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(),
                      [](const RayNode& x, const RayNode& y) { return x.kind == y.kind; });
  }

  double one_place_, told_apart_, shadow_;  // in world lengths
};

}  // namespace

std::optional<Cause> first_divergence(const RayNode& ours, const RayNode& other, double extent,
                                      const renderers::Resolution& resolution) {
  return Divergence(extent, resolution).first(ours, other, {});
}

}  // namespace plumb::attribution
