// All that happens to one pixel: its rays, what they meet, and what each light does there.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "tracer/scene/shot.hpp"
#include "tracer/textbook/formula_table.hpp"
#include "tracer/textbook/ray_budget.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::attribution {

/// A place where a ray meets a surface, in world space.
struct Meeting {
  textbook::SurfaceId surface;
  ShapeId shape;
  double t;  ///< in world lengths, because the direction is normalised
  Vec3d point;
  Vec3d normal;                                     ///< of unit length, facing the viewer
  std::vector<textbook::LightSeen<double>> lights;  ///< one for each light of the scene
};

/// A ray and those that follow from it. One that meets nothing sees the background.
struct RayNode {
  textbook::RayKind kind = textbook::RayKind::camera;
  Ray<double> ray;
  int depth = 0;
  bool is_at_depth_limit = false;  ///< true: it is black and was not traced
  bool is_cut = false;             ///< true: rays that follow were not traced, the tree would be too large
  std::optional<Meeting> meeting;
  Rgbd colour{0};  ///< what it brings back; 0 for rays that were not traced
  std::vector<RayNode> children;
};

/// Records what a tracer tells, and ends it where a pixel has too many rays; copies record to the same tree.
class Recorder {
 public:
  explicit Recorder(const textbook::RayBudget<double>& budget) : state_(std::make_shared<State>(budget)) {}

  bool ray_begins(textbook::RayKind kind, const Ray<double>& ray, int depth) const;
  void is_black_at_depth_limit() const;
  void meets(const textbook::Hit<double>& hit, const textbook::Surface<double>& surface, const Vec3d& point,
             const Vec3d& normal) const;
  void is_lit_by(std::size_t light, const textbook::LightSeen<double>& seen) const;
  void ray_ends(const Rgbd& colour) const;

  /// Takes out the tree of the last pixel and returns it.
  RayNode take() const;

 private:
  struct State {
    explicit State(const textbook::RayBudget<double>& of_pixel) : budget(of_pixel) {}
    textbook::RayBudget<double> budget;
    std::vector<RayNode> open;  ///< from the camera ray to the one that is being traced
    RayNode finished;
  };
  RayNode& current() const { return state_->open.back(); }

  std::shared_ptr<State> state_;
};

/// True if rays of the tree were not traced.
bool is_cut(const RayNode& tree);

/// Which surfaces are met and which lights are seen, in one number: trees that have the same differ in
/// lengths and colours alone, and their pixels lie on no edge between them.
std::uint64_t course_of(const RayNode& tree);

/// Traces ray trees of the pixels of one picture.
class TreeTracer {
 public:
  /// The scene must outlive it.
  explicit TreeTracer(const Shot& shot);
  /// The same, charged to `work`, which must outlive it.
  TreeTracer(const Shot& shot, textbook::Work& work);
  TreeTracer(const TreeTracer&) = delete;
  TreeTracer& operator=(const TreeTracer&) = delete;

  /// Returns the tree of a pixel. Row 0 is the top row.
  RayNode tree_of(int x, int y) const;

 private:
  using Formulas = textbook::ReplaceableFormulas<double>;
  textbook::Work unlimited_{std::numeric_limits<double>::infinity()};
  textbook::World<double> world_;
  Recorder recorder_;
  textbook::Tracer<double, Formulas, Recorder> tracer_;
};

}  // namespace plumb::attribution
