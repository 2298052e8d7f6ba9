#include "references/diagnosis/float_noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "references/attribution/perturbation.hpp"
#include "references/renderers/ours.hpp"
#include "tracer/scene/each_kind.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::diagnosis {
namespace {

/// because a tracer rounds some 32 times, 2^-25 each on average and by chance up or down, on the way to a hit
/// through composites and mirrors: three times the root of their number
constexpr double rounding_of_float = 0x1p-21;
/// because more of a shape's size would be seen
constexpr double most_of_a_shape = 1e-3;

/// Returns by how much float32 moves a sphere, in its own space. The square of the distance over the size
/// counts, because the discriminant of a small, far sphere is a difference of such squares.
double step_of(const Sphere& sphere, const Mat4<double>& world_from_object, const Vec3d& eye) {
  double enlargement = 0;
  for (int axis = 0; axis < 3; ++axis)
    enlargement = std::max(enlargement, glm::length(Vec3d(world_from_object[axis])));
  const double size = sphere.radius;
  const Vec3d middle(world_from_object * glm::dvec4(sphere.center, 1));
  const double reach = glm::length(middle) + glm::length(middle - eye) + size * enlargement;
  if (!(enlargement > 0) || !(size > 0) || !std::isfinite(reach)) return 0;
  const double step = rounding_of_float * reach * (1 + reach / (size * enlargement)) / enlargement;
  return std::min(step, most_of_a_shape * size);
}

/// Returns, along each axis of an object, the largest number that is rounded when rays from these places come
/// into its space. A face is as exact as its own coordinate and this number, however large the box is.
Vec3d coordinates_of_rays(const Mat4<double>& object_from_world, const std::vector<Vec3d>& places) {
  Vec3d most(0);
  for (const Vec3d& place : places) {
    Vec3d sum = glm::abs(Vec3d(object_from_world[3]));
    for (int axis = 0; axis < 3; ++axis)
      sum += glm::abs(Vec3d(object_from_world[axis])) * std::abs(place[axis]);
    most = glm::max(most, sum);
  }
  return most;
}

/// Returns a number between -1 and 1. It is the same for equal values along one axis: float32 keeps equal
/// what is equal.
double part_of(int number, int axis, double value) {
  std::seed_seq seed{static_cast<std::uint64_t>(number), static_cast<std::uint64_t>(axis),
                     std::bit_cast<std::uint64_t>(value + 0.0) >> 32U,
                     std::bit_cast<std::uint64_t>(value + 0.0) & 0xffffffffU};
  std::mt19937 random(seed);
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

void move(Sphere& sphere, const Vec3d& step, int number, double share) {
  constexpr int of_radius = 3;
  sphere.radius += share * step.x * part_of(number, of_radius, sphere.radius);
  for (int axis = 0; axis < 3; ++axis)
    sphere.center[axis] += share * step.x * part_of(number, axis, sphere.center[axis]);
}

void move(Box& box, const Vec3d& coordinates, int number, double share) {
  const double most = most_of_a_shape * glm::length(box.max - box.min) / 2;
  const auto moved = [&](int axis, double face) {
    const double step = std::min(most, rounding_of_float * (std::abs(face) + coordinates[axis]));
    return face + share * step * part_of(number, axis, face);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double least = moved(axis, box.min[axis]);
    box.max[axis] = std::max(least, moved(axis, box.max[axis]));
    box.min[axis] = least;
  }
}

/// Returns the share of a step. Near an edge the smallest move shows the outcome best.
double part_of_step(int number) {
  constexpr double parts[] = {1, 0.1, 0.01};
  return parts[number % 3];
}

/// Returns the error of the worst component of each pixel, relative above 1; infinite where one is no number.
std::vector<float> errors_of(const Image& image, const Image& right) {
  std::vector<float> errors(right.rgb.size() / 3, 0);
  for (std::size_t i = 0; i < right.rgb.size(); ++i) {
    const float error = std::abs(image.rgb[i] - right.rgb[i]) / std::max(1.0F, std::abs(right.rgb[i]));
    float& worst = errors[i / 3];
    worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<float>::infinity();
  }
  return errors;
}

/// Returns the error that nine of ten pixels do not exceed.
float most_common(std::vector<float> errors) {
  const auto nine_of_ten = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 9 / 10);
  std::nth_element(errors.begin(), nine_of_ten, errors.end());
  return *nine_of_ten;
}

/// Returns the largest error of a pixel and its neighbours, without jumps, which are no errors.
float largest_about(const std::vector<float>& errors, int width, int height, int x, int y) {
  float largest = 0;
  for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
      const float error =
          errors[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
      if (error <= most_of_an_error) largest = std::max(largest, error);
    }
  }
  return largest;
}

}  // namespace

FloatErrors float_errors(const Scene& scene, const Camera& camera, const RenderJob& job,
                         const Image& in_double) {
  constexpr float least = 1e-6F, most_everywhere = 1e-5F;
  RenderJob in_float = job;
  in_float.real = RealType::float32;
  const std::vector<float> errors =
      errors_of(renderers::render(renderers::OwnTracer::engine, scene, camera, in_float), in_double);
  const float everywhere = std::clamp(other_tracer * most_common(errors), least, most_everywhere);
  FloatErrors found;
  for (int y = 0; y < job.height; ++y) {
    for (int x = 0; x < job.width; ++x) {
      const float about = other_tracer * largest_about(errors, job.width, job.height, x, y);
      found.measured.push_back(std::min(about, most_of_an_error));
      found.allowed.push_back(std::clamp(about, everywhere, most_of_an_error));
    }
  }
  return found;
}

FloatMoves::FloatMoves(const Scene& scene, const Camera& camera)
    : scene_(attribution::with_instances_apart(scene)), steps_(scene_.shapes.size(), Vec3d(0)) {
  const Vec3d eye(product_of<double>(camera.transform).matrix * glm::dvec4(camera.eye, 1));
  std::vector<Vec3d> places{eye};
  for (const Light& light : scene_.lights) places.push_back(light.position);
  for_each_instance(scene_, [&](const Instance& instance) {
    const Vec3d step = std::visit(
        EachKind{[&](const Sphere& sphere) {
                   return Vec3d(step_of(sphere, instance.world_from_object.matrix, eye));
                 },
                 [&](const Box&) { return coordinates_of_rays(instance.world_from_object.inverse, places); },
                 [](const Composite&) { return Vec3d(0); }},
        scene_.shapes[instance.shape].geometry);
    steps_[instance.shape] = glm::max(steps_[instance.shape], step);
  });
}

Scene FloatMoves::moved(int number) const {
  Scene moved = scene_;
  if (number == 0) return moved;
  for (ShapeId id = 0; id < moved.shapes.size(); ++id) {
    std::visit(
        EachKind{[&](Sphere& sphere) { move(sphere, steps_[id], number, part_of_step(number)); },
                 [&](Box& box) { move(box, steps_[id], number, part_of_step(number)); }, [](Composite&) {}},
        moved.shapes[id].geometry);
  }
  return moved;
}

}  // namespace plumb::diagnosis
