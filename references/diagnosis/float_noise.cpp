#include "references/diagnosis/float_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "references/perturbation.hpp"
#include "references/renderer.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::references {
namespace {

/// because a tracer rounds some 32 times, 2^-25 each on average and by chance up or down, on the way to a hit
/// through composites and mirrors: three times the root of their number
constexpr double rounded = 0x1p-21;
/// because more of a shape's size would be seen
constexpr double most_of_a_shape = 1e-3;
/// because what float32 is off by more at is another surface or another light
constexpr float most_of_an_error = 1e-3F;

Vec3d middle_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) return sphere->center;
  const auto* box = std::get_if<Box>(&shape.geometry);
  return box == nullptr ? Vec3d(0) : (box->min + box->max) / 2.0;
}

double size_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) return sphere->radius;
  const auto* box = std::get_if<Box>(&shape.geometry);
  return box == nullptr ? 0 : glm::length(box->max - box->min) / 2;
}

/// By how much float32 moves a shape, in its own space. Of spheres the distance counts with its square over
/// the size, because the discriminant of a small sphere far away is a difference of such squares.
double step_of(const Shape& shape, const Mat4<double>& world_from_object, const Vec3d& eye) {
  double enlargement = 0;
  for (int axis = 0; axis < 3; ++axis)
    enlargement = std::max(enlargement, glm::length(Vec3d(world_from_object[axis])));
  const double size = size_of(shape);
  const Vec3d middle(world_from_object * glm::dvec4(middle_of(shape), 1));
  const double reach = glm::length(middle) + glm::length(middle - eye) + size * enlargement;
  if (!(enlargement > 0) || !(size > 0) || !std::isfinite(reach)) return 0;
  const bool has_discriminant = std::holds_alternative<Sphere>(shape.geometry);
  const double squares = has_discriminant ? reach / (size * enlargement) : 0;
  const double step = rounded * reach * (1 + squares) / enlargement;
  return std::min(step, most_of_a_shape * size);
}

void move(Shape& shape, double step, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-step, step);
  const auto some = [&] { return Vec3d(part(random), part(random), part(random)); };
  if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    sphere->radius += part(random);
    sphere->center += some();
  } else if (auto* box = std::get_if<Box>(&shape.geometry)) {
    box->min += some();
    box->max = glm::max(box->min, box->max + some());
  }
}

/// Near an edge the least move tells the outcome best.
double part_of_step(int number) {
  constexpr double parts[] = {1, 0.1, 0.01};
  return parts[number % 3];
}

/// Of the worst component of each pixel, relative above 1; infinite where one is no number.
std::vector<float> errors_of(const Image& image, const Image& right) {
  std::vector<float> errors(right.rgb.size() / 3, 0);
  for (std::size_t i = 0; i < right.rgb.size(); ++i) {
    const float error = std::abs(image.rgb[i] - right.rgb[i]) / std::max(1.0F, std::abs(right.rgb[i]));
    float& worst = errors[i / 3];
    worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<float>::infinity();
  }
  return errors;
}

/// What nine of ten pixels are not off by.
float most_common(std::vector<float> errors) {
  const auto nine_of_ten = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 9 / 10);
  std::nth_element(errors.begin(), nine_of_ten, errors.end());
  return *nine_of_ten;
}

/// The largest of a pixel and its neighbours, apart from jumps, which no error is.
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
  constexpr float other_tracer = 4;  // because another order of the same operations rounds otherwise
  RenderJob in_float = job;
  in_float.real = RealType::float32;
  const std::vector<float> errors = errors_of(render(Renderer::engine, scene, camera, in_float), in_double);
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
    : scene_(with_instances_apart(scene)), steps_(scene_.shapes.size(), 0) {
  const Vec3d eye(product_of<double>(camera.transform).matrix * glm::dvec4(camera.eye, 1));
  for_each_instance(scene_, [&](const Instance& instance) {
    const double step = step_of(scene_.shapes[instance.shape], instance.world_from_object.matrix, eye);
    steps_[instance.shape] = std::max(steps_[instance.shape], step);
  });
}

bool FloatMoves::is_small(int number) { return number == 0 || part_of_step(number) < 1; }

Scene FloatMoves::moved(int number) const {
  Scene moved = scene_;
  if (number == 0) return moved;
  std::mt19937 random(static_cast<std::uint32_t>(number));
  for (ShapeId id = 0; id < moved.shapes.size(); ++id)
    move(moved.shapes[id], part_of_step(number) * steps_[id], random);
  return moved;
}

}  // namespace plumb::references
