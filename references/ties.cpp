#include "references/ties.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <set>

#include "exporters/povray.hpp"
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

/// What is as near to the lit point as that is taken for the surface itself.
bool blocks_from_afar(double t, double light_distance) {
  return t > 10 * relative_step * light_distance && t < light_distance;
}

textbook::FormulaTable<double> formulas_for_pattern(int pattern) {
  textbook::FormulaTable<double> table;
  if (pattern % 2 == 1) table.intersect_box = &leaving_at_edges;
  if (pattern % 4 > 1) table.blocks_light = &blocks_from_afar;
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

Scene moved_at_random(Scene scene, double step, std::mt19937& random) {
  for (Shape& shape : scene.shapes) move_surface(shape, step, random);
  return scene;
}

/// Adds the shapes whose move alone changes one of the pixels.
void name_shapes(const Scene& scene, const Camera& camera, const RenderOptions& options, const Image& like,
                 const std::vector<PixelPlace>& pixels, double step, double tolerance, std::mt19937& random,
                 std::set<ShapeId>& found) {
  const PixelTracer still(scene, camera, like, options);
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    if (material_of(scene.shapes[id]) == nullptr) continue;
    for (int i = 0; i < patterns_of_one && !found.contains(id); ++i) {
      Scene moved = scene;
      move_surface(moved.shapes[id], step, random);
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

/// Tries the pattern on every pixel that is not proven yet.
void try_pattern(const PixelTracer& moved, const Image& reference, double tolerance,
                 std::vector<Suspect>& suspects) {
  const double jump = std::max(tolerance, smallest_jump);
  for (Suspect& s : suspects) {
    if (s.is_tied()) continue;
    const Colour outcome = moved.at(s.place);
    s.varies = s.varies || !is_within(s.unmoved.data(), outcome.data(), jump);
    s.is_reproduced =
        s.is_reproduced || is_within(reference.pixel(s.place.x, s.place.y), outcome.data(), tolerance);
  }
}

/// At most `count` of the pixels, spread evenly.
std::vector<PixelPlace> sample_of(const std::vector<PixelPlace>& pixels, std::size_t count) {
  std::vector<PixelPlace> sample;
  const std::size_t stride = std::max<std::size_t>(1, pixels.size() / count);
  for (std::size_t i = 0; i < pixels.size(); i += stride) sample.push_back(pixels[i]);
  return sample;
}

}  // namespace

TieReport prove_ties(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const Image& reference, const std::vector<PixelPlace>& pixels, double tolerance) {
  if (pixels.empty()) return {};
  const double step = relative_step * scene_extent(scene, camera);
  std::mt19937 random(1);  // any seed: the patterns are to be the same every time
  const PixelTracer still(scene, camera, reference, options);
  std::vector<Suspect> suspects;
  for (const PixelPlace place : pixels) suspects.push_back({place, still.at(place)});
  for (int pattern = 0; pattern < most_patterns; ++pattern) {
    if (pattern == patterns) std::erase_if(suspects, [](const Suspect& s) { return !s.varies; });
    if (std::all_of(suspects.begin(), suspects.end(), [](const Suspect& s) { return s.is_tied(); })) break;
    // The smaller step is small against what leaving_at_edges takes for an edge.
    const double move = pattern % 8 < 4 ? step : step / 1000;
    const PixelTracer moved(moved_at_random(scene, move, random), camera, reference, options,
                            formulas_for_pattern(pattern));
    try_pattern(moved, reference, tolerance, suspects);
  }
  std::vector<PixelPlace> tied;
  for (const Suspect& suspect : suspects) {
    if (suspect.is_tied()) tied.push_back(suspect.place);
  }
  TieReport report{tied.size(), {}};
  if (tied.empty()) return report;
  std::set<ShapeId> found;
  name_shapes(scene, camera, options, reference, sample_of(tied, pixels_named), step, tolerance, random,
              found);
  for (const ShapeId id : found) report.shapes.push_back(scene.shapes[id].name);
  return report;
}

}  // namespace plumb::references
