// Counts what really happens while a picture is traced, as an observer of the textbook tracer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/scene/render_job.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/observer.hpp"

namespace plumb::studies {

/// How rays touch a sphere or box, summed over all paths by which it stands in the world.
struct Touches {
  std::uint64_t camera = 0;     ///< rays from the eye whose nearest hit it is
  std::uint64_t secondary = 0;  ///< other rays
  std::uint64_t blocked = 0;    ///< shadow rays for which it is the blocker that was found

  std::uint64_t hits() const { return camera + secondary; }
  bool any() const { return hits() + blocked > 0; }
};

/// Counts over the pixels looked at. Rays that are black at the depth limit are counted there alone.
struct Observed {
  std::size_t pixels = 0, looked_at = 0;
  std::size_t cut = 0;  ///< pixels with more than most_rays_of_pixel rays, of which the rest was not seen
  std::array<std::uint64_t, 5> rays{};  ///< by textbook::RayKind
  std::uint64_t background = 0;         ///< rays that meet nothing
  std::uint64_t black_at_limit = 0;
  int deepest = 0;                             ///< depth of the deepest ray; that of a camera ray is 0
  std::uint64_t nested = 0;                    ///< rays inside at least two media
  std::uint64_t ambient = 0;                   ///< hits to which ambient light adds
  std::uint64_t diffuse = 0, specular = 0;     ///< number of times that a light adds them to a hit
  std::uint64_t shadow_rays = 0, shadows = 0;  ///< number asked, and number blocked
  std::vector<Touches> shapes;                 ///< by ShapeId; nothing for composites
  std::vector<std::uint64_t> lights;           ///< number of times that each adds light to a hit

  bool is_whole() const { return looked_at == pixels && cut == 0; }
  std::uint64_t of(textbook::RayKind kind) const { return rays.at(static_cast<std::size_t>(kind)); }
  void add(const Observed& other);
};

/// Traces the picture's pixels in double, one sample each: all of them when that is not too much work, else
/// spread ones. Expects a scene as read_scene returns it without errors.
Observed observe(const Scene& scene, const Camera& camera, const RenderJob& job);

}  // namespace plumb::studies
