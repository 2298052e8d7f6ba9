#include "references/ties.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <set>

#include "exporters/povray.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::references {
namespace {

constexpr double relative_step = 1e-8;
constexpr int patterns = 24;              // two surfaces stay in one order in all of them once in 2^23 cases
constexpr std::size_t pixels_named = 64;  // the shapes are looked for in so many tied pixels

using Colour = std::array<float, 3>;

/// A scene and what traces single pixels of it.
class PixelTracer {
 public:
  PixelTracer(Scene scene, const Camera& camera, const Image& like, const RenderOptions& options)
      : scene_(std::move(scene)),
        world_(scene_, textbook::FormulaTable<double>{}),
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

/// Moves the surface outward by `step` (inward when negative); a composite is scaled about its origin.
void move_surface(Shape& shape, double step) {
  if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    sphere->radius = std::max(sphere->radius + step, sphere->radius / 2);
  } else if (auto* box = std::get_if<Box>(&shape.geometry)) {
    box->min -= Vec3d(step);
    box->max += Vec3d(step);
    box->min = glm::min(box->min, box->max);
  }
}

double scene_extent(const Scene& scene, const Camera& camera) {
  constexpr double exported_extent = 1e4;
  return exported_extent / exporters::export_space(scene, camera).scale;
}

Scene moved_at_random(Scene scene, double step, std::mt19937& random) {
  for (Shape& shape : scene.shapes) move_surface(shape, (random() & 1U) != 0 ? step : -step);
  return scene;
}

/// Adds the shapes whose move alone changes one of the pixels.
void name_shapes(const Scene& scene, const Camera& camera, const RenderOptions& options, const Image& like,
                 const std::vector<PixelPlace>& pixels, double step, double tolerance, std::set<ShapeId>& found) {
  const PixelTracer still(scene, camera, like, options);
  for (ShapeId id = 0; id < scene.shapes.size(); ++id) {
    if (material_of(scene.shapes[id]) == nullptr) continue;
    for (const double by : {step, -step}) {
      Scene moved = scene;
      move_surface(moved.shapes[id], by);
      const PixelTracer tracer(std::move(moved), camera, like, options);
      const bool changes = std::any_of(pixels.begin(), pixels.end(), [&](PixelPlace place) {
        return !is_within(still.at(place).data(), tracer.at(place).data(), tolerance);
      });
      if (changes) found.insert(id);
    }
  }
}

}  // namespace

TieReport prove_ties(const Scene& scene, const Camera& camera, const RenderOptions& options, const Image& reference,
                     const std::vector<PixelPlace>& pixels, double tolerance) {
  TieReport report;
  if (pixels.empty()) return report;
  const double step = relative_step * scene_extent(scene, camera);
  std::mt19937 random(1);  // any seed: the patterns are to be the same every time
  std::vector<std::unique_ptr<PixelTracer>> moved;
  moved.push_back(std::make_unique<PixelTracer>(scene, camera, reference, options));
  for (int i = 0; i < patterns; ++i) {
    moved.push_back(
        std::make_unique<PixelTracer>(moved_at_random(scene, step, random), camera, reference, options));
  }
  std::vector<PixelPlace> tied;
  for (const PixelPlace place : pixels) {
    const bool reproduced = std::any_of(moved.begin() + 1, moved.end(), [&](const auto& tracer) {
      return is_within(reference.pixel(place.x, place.y), tracer->at(place).data(), tolerance);
    });
    if (reproduced) tied.push_back(place);
  }
  report.proven = tied.size();
  if (tied.empty()) return report;
  std::vector<PixelPlace> sample;
  const std::size_t stride = std::max<std::size_t>(1, tied.size() / pixels_named);
  for (std::size_t i = 0; i < tied.size(); i += stride) sample.push_back(tied[i]);
  std::set<ShapeId> found;
  name_shapes(scene, camera, options, reference, sample, step, tolerance, found);
  for (const ShapeId id : found) report.shapes.push_back(scene.shapes[id].name);
  return report;
}

}  // namespace plumb::references
