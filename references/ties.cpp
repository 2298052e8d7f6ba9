#include "references/ties.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <set>

#include "exporters/povray.hpp"
#include "tracer/scene/hierarchy.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::references {
namespace {

constexpr double relative_step = 1e-8;
constexpr double smallest_jump = 1e-5;  // moving by 1e-8 changes a smooth pixel by far less
constexpr int patterns = 48;            // two surfaces stay in one order in all of them once in 2^47 cases
constexpr int most_patterns = 4096;     // for pixels that vary: many ties in one ray tree have many outcomes
constexpr int patterns_of_one = 6;      // of a single shape, to find out whether it takes part
constexpr std::size_t pixels_named = 64;  // the shapes are looked for in so many tied pixels

using Colour = std::array<float, 3>;

/// A scene and what traces single pixels of it.
class PixelTracer {
 public:
  PixelTracer(Scene scene, const Camera& camera, const Image& like, const RenderOptions& options,
              const textbook::FormulaTable<double>& formulas = {})
      : scene_(std::move(scene)),
        world_(scene_, formulas),
        tracer_(world_, camera, like.width, like.height, options) {}
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;

  Colour at(PixelPlace place) const {
    const Rgbd colour = tracer_.raycast(place.x, place.y);
    return {static_cast<float>(colour.x), static_cast<float>(colour.y), static_cast<float>(colour.z)};
  }

 private:
  Scene scene_;
  textbook::World<double> world_;
  textbook::Tracer<double> tracer_;
};

/// Where a ray only touches the edge of a box, it enters and leaves at once: this takes the face it leaves
/// by.
std::optional<FaceHit<double>> leaving_at_edges(const Ray<double>& ray, const Corners<double>& box,
                                                Face start) {
  const auto hit = formulas::intersect_box(ray, box, start);
  if (!hit || start != no_face) return hit;
  const auto leaving =
      formulas::intersect_box({formulas::point_at(ray, hit->t), ray.direction}, box, hit->face);
  return leaving && leaving->t <= 10 * relative_step * hit->t ? FaceHit<double>{hit->t, leaving->face} : *hit;
}

/// What is as near to the lit point as that is taken for the surface itself. An entry of the table has no
/// state of its own, and each call of prove_ties runs in one thread.
thread_local double nearest_blocker = 0;

bool blocks_from_afar(double t, double light_distance) { return t > nearest_blocker && t < light_distance; }

/// What is as near to the start of a ray is not met at all: of surfaces that coincide one is crossed.
thread_local double nearest_hit = 0;

bool is_far_ahead(double t, double rounding) { return t > rounding && t > nearest_hit; }

/// Of two hits that are as near to each other either is taken, each time by chance.
thread_local std::mt19937 chance;

bool is_nearer_or_by_chance(double t, double nearest, double) {
  return std::abs(t - nearest) <= nearest_hit ? (chance() & 1U) != 0 : t < nearest;
}

textbook::FormulaTable<double> formulas_for_pattern(int pattern) {
  textbook::FormulaTable<double> table;
  if (pattern % 2 == 1) table.intersect_box = &leaving_at_edges;
  if (pattern % 4 > 1) table.blocks_light = &blocks_from_afar;
  if (pattern % 16 > 7) {
    table.is_ahead = &is_far_ahead;
    table.is_nearer = &is_nearer_or_by_chance;
  }
  return table;
}

/// Moves every face of a box, and the surface of a sphere, by `step` one way or the other.
void move_surface(Shape& shape, double step, std::mt19937& random) {
  const auto either = [&] { return (random() & 1U) != 0 ? step : -step; };
  if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    sphere->radius = std::max(sphere->radius + either(), sphere->radius / 2);
    sphere->center += Vec3d(either(), either(), either());
  } else if (auto* box = std::get_if<Box>(&shape.geometry)) {
    box->min += Vec3d(either(), either(), either());
    box->max = glm::max(box->min, box->max + Vec3d(either(), either(), either()));
  }
}

double scene_extent(const Scene& scene, const Camera& camera) {
  constexpr double exported_extent = 1e4;
  return exported_extent / exporters::export_space(scene, camera).scale;
}

/// The world step in the space of each shape: divided by the most that any of its instances enlarges it.
std::vector<double> steps_in_object_space(const Scene& scene, double world_step) {
  std::vector<double> enlargement(scene.shapes.size(), 0);
  for_each_instance(scene, [&](const Instance& instance) {
    const Mat4<double>& m = instance.world_from_object.matrix;
    for (int axis = 0; axis < 3; ++axis) {
      enlargement[instance.shape] = std::max(enlargement[instance.shape], glm::length(Vec3d(m[axis])));
    }
  });
  for (double& e : enlargement) e = e > 0 ? world_step / e : 0;
  return enlargement;
}

/// Adds a copy of the shape and of all below it; every child has one parent then. Returns its place.
ShapeId copy_apart(const Scene& from, ShapeId id, Scene& to) {
  const ShapeId copy = to.shapes.size();
  to.shapes.push_back(from.shapes[id]);
  if (const auto* composite = std::get_if<Composite>(&from.shapes[id].geometry)) {
    std::vector<ShapeId> children;
    for (const ShapeId child : composite->children) children.push_back(copy_apart(from, child, to));
    to.shapes[copy].geometry = Composite{std::move(children)};
  }
  return copy;
}

/// The same world, in which every instance of a shared shape is one of its own, so that each can be moved
/// alone; or the scene as it is, when those would be too many.
Scene with_instances_apart(const Scene& scene) {
  constexpr std::uint64_t most = 2000;
  const std::vector<ShapeId> roots = scene.roots();
  const std::vector<std::uint64_t> counts = count_instances(scene);
  std::uint64_t all = 0;
  for (const ShapeId root : roots) all += std::min(counts[root], most);
  if (all > most) return scene;
  Scene apart = scene;
  apart.shapes.clear();
  for (const ShapeId root : roots) copy_apart(scene, root, apart);
  return apart;
}

Scene moved_at_random(Scene scene, const std::vector<double>& steps, double factor, std::mt19937& random) {
  for (ShapeId id = 0; id < scene.shapes.size(); ++id)
    move_surface(scene.shapes[id], factor * steps[id], random);
  return scene;
}

/// Adds the shapes whose move alone changes one of the pixels.
void name_shapes(const Scene& scene, const Camera& camera, const RenderOptions& options, const Image& like,
                 const std::vector<PixelPlace>& pixels, const std::vector<double>& steps, double tolerance,
                 std::mt19937& random, std::set<ShapeId>& found) {
  const PixelTracer still(scene, camera, like, options);
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    if (material_of(scene.shapes[id]) == nullptr) continue;
    for (int i = 0; i < patterns_of_one && !found.contains(id); ++i) {
      Scene moved = scene;
      move_surface(moved.shapes[id], steps[id], random);
      const PixelTracer tracer(std::move(moved), camera, like, options);
      const bool changes = std::any_of(pixels.begin(), pixels.end(), [&](PixelPlace place) {
        return !is_within(still.at(place).data(), tracer.at(place).data(), tolerance);
      });
      if (changes) found.insert(id);
    }
  }
}

/// A pixel over the tolerance while it is tried.
struct Suspect {
  PixelPlace place;
  Colour unmoved;
  bool varies = false;         ///< moving surfaces makes it jump
  bool is_reproduced = false;  ///< and one outcome is the reference's

  bool is_tied() const { return varies && is_reproduced; }
};

/// Tries the pattern on every pixel that is not proven yet. What changes by more than `jump` is not smooth.
void try_pattern(const PixelTracer& moved, const Image& reference, double tolerance, double jump,
                 std::vector<Suspect>& suspects) {
  for (Suspect& s : suspects) {
    if (s.is_tied()) continue;
    const Colour outcome = moved.at(s.place);
    s.varies = s.varies || !is_within(s.unmoved.data(), outcome.data(), jump);
    s.is_reproduced =
        s.is_reproduced || is_within(reference.pixel(s.place.x, s.place.y), outcome.data(), tolerance);
  }
}

/// How many patterns are worth trying: a picture that differs as a whole is no matter of ties.
int affordable_patterns(std::size_t suspects, const Scene& scene) {
  constexpr double most_traces = 4e6;
  const double each = static_cast<double>(suspects) + static_cast<double>(scene.shapes.size());
  return static_cast<int>(std::min<double>(most_patterns, most_traces / each));
}

/// At most `count` of the pixels, spread evenly.
std::vector<PixelPlace> sample_of(const std::vector<PixelPlace>& pixels, std::size_t count) {
  std::vector<PixelPlace> sample;
  const std::size_t stride = std::max<std::size_t>(1, pixels.size() / count);
  for (std::size_t i = 0; i < pixels.size(); i += stride) sample.push_back(pixels[i]);
  return sample;
}

}  // namespace

TieReport prove_ties(const Scene& shared, const Camera& camera, const RenderOptions& options,
                     const Image& reference, const std::vector<PixelPlace>& pixels, double tolerance) {
  if (pixels.empty()) return {};
  const Scene scene = with_instances_apart(shared);
  const int affordable = affordable_patterns(pixels.size(), scene);
  if (affordable < patterns) return {};
  const double world_step = relative_step * scene_extent(scene, camera);
  const auto steps = steps_in_object_space(scene, world_step);
  nearest_hit = world_step;
  nearest_blocker = 10 * world_step;  // POV-Ray's shadow tolerance, 1e-3 of 1e4 units
  std::mt19937 random(1);             // any seed: the patterns are to be the same every time
  std::vector<Suspect> suspects;
  const PixelTracer still(scene, camera, reference, options);
  for (const PixelPlace place : pixels) suspects.push_back({place, still.at(place)});
  for (int pattern = 0; pattern < affordable; ++pattern) {
    if (pattern == patterns) std::erase_if(suspects, [](const Suspect& s) { return !s.varies; });
    if (std::all_of(suspects.begin(), suspects.end(), [](const Suspect& s) { return s.is_tied(); })) break;
    // The smaller step is small against what leaving_at_edges takes for an edge.
    const double factor = pattern % 8 < 4 ? 1 : 1e-3;
    const PixelTracer moved(moved_at_random(scene, steps, factor, random), camera, reference, options,
                            formulas_for_pattern(pattern));
    try_pattern(moved, reference, tolerance, std::max(tolerance, factor * smallest_jump), suspects);
  }
  std::vector<PixelPlace> tied;
  for (const Suspect& suspect : suspects) {
    if (suspect.is_tied()) tied.push_back(suspect.place);
  }
  if (tied.empty()) return {};
  std::set<ShapeId> found;
  name_shapes(scene, camera, options, reference, sample_of(tied, pixels_named), steps, tolerance, random,
              found);
  if (found.empty()) return {};  // whatever it is, no surfaces that coincide
  TieReport report{tied.size(), {}};
  for (const ShapeId id : found) {
    const std::string& name = scene.shapes[id].name;
    if (std::find(report.shapes.begin(), report.shapes.end(), name) == report.shapes.end())
      report.shapes.push_back(name);
  }
  return report;
}

}  // namespace plumb::references
