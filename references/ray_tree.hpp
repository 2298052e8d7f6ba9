// All that happens to one pixel: its rays, what they meet, and what each light does there.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/formula_table.hpp"
#include "tracer/textbook/observer.hpp"

namespace plumb::references {

/// A place where a ray meets a surface, in world space.
struct Meeting {
  textbook::SurfaceId surface;
  ShapeId shape;
  double t;  ///< world lengths, for the direction is normalised
  Vec3d point;
  Vec3d normal;                                     ///< of unit length, facing the viewer
  std::vector<textbook::LightSeen<double>> lights;  ///< one for each light of the scene
};

/// A ray and those that follow from it. One that meets nothing sees the background.
struct RayNode {
  textbook::RayKind kind = textbook::RayKind::camera;
  Ray<double> ray;
  int depth = 0;
  bool is_at_depth_limit = false;  ///< it is black and was not traced
  bool is_cut = false;             ///< rays that follow are left out: the tree would be too large
  std::optional<Meeting> meeting;
  Rgbd colour{0};  ///< what it brings back
  std::vector<RayNode> children;
};

/// Records what a tracer tells; copies record to the same tree. Of a pixel with more rays than `most_rays`
/// the first ones are kept, in the order in which they are traced.
class Recorder {
 public:
  static constexpr std::size_t most_rays = 3000;

  Recorder() : state_(std::make_shared<State>()) {}

  void ray_begins(textbook::RayKind kind, const Ray<double>& ray, int depth) const;
  void is_black_at_depth_limit() const;
  void meets(const textbook::Hit<double>& hit, const textbook::Surface<double>& surface, const Vec3d& point,
             const Vec3d& normal) const;
  void is_lit_by(std::size_t light, const textbook::LightSeen<double>& seen) const;
  void ray_ends(const Rgbd& colour) const;

  /// The tree of the last pixel. Takes it out.
  RayNode take() const;

 private:
  struct State {
    std::vector<RayNode> open;  ///< from the camera ray to the one that is being traced
    RayNode finished;
    std::size_t rays = 0;
    std::size_t left_out = 0;  ///< open rays that are not recorded
  };
  RayNode& current() const { return state_->open.back(); }

  std::shared_ptr<State> state_;
};

/// The ray tree of one pixel; row 0 is the top row. `formulas` as another tracer has them.
RayNode ray_tree(const Scene& scene, const Camera& camera, int width, int height,
                 const RenderOptions& options, int x, int y,
                 const textbook::FormulaTable<double>& formulas = {});

}  // namespace plumb::references
