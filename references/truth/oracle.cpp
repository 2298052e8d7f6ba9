#include "references/truth/oracle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>

#include "references/attribution/perturbation.hpp"
#include "references/attribution/ray_tree.hpp"
#include "references/comparison/comparison.hpp"
#include "tracer/scene/dielectrics.hpp"

namespace plumb::truth {
namespace {

/// Of a number's size: what a few correct roundings leave open.
constexpr double last_digits = 4 * 0x1p-53;

double size_of(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool keeps_equals(int pattern) { return pattern >= Oracle::free_patterns; }

/// Moves numbers one way or the other, the same way every time for a pattern.
class Mover {
 public:
  Mover(int pattern, std::uint32_t seed) : keeps_equals_(keeps_equals(pattern)), seed_(seed), random_(seed) {}

  void move(double& number) { move(number, std::abs(number), 0); }
  void move_each(Vec3d& numbers) {
    for (int axis = 0; axis < 3; ++axis) move(numbers[axis], std::abs(numbers[axis]), axis);
  }
  void move(Vec3d& place, double size) {
    for (int axis = 0; axis < 3; ++axis) move(place[axis], size, axis);
  }
  void move(Vec3d& place) { move(place, size_of(place)); }

  void operator()(Sphere& sphere) {
    const double size = std::max(size_of(sphere.center), sphere.radius);
    move(sphere.center, size);
    move(sphere.radius);
  }
  void operator()(Box& box) {
    const double size = std::max(size_of(box.min), size_of(box.max));
    move(box.min, size);
    move(box.max, size);
    box.max = glm::max(box.min, box.max);
  }
  void operator()(const Composite&) {}

  void operator()(Translate& step) { move(step.by); }
  void operator()(Rotate& step) {
    move(step.degrees);
    move(step.axis);
  }
  void operator()(Scale& step) { move_each(step.by); }

 private:
  /// Equal numbers of one axis stay equal only where both way and length follow from them alone.
  void move(double& number, double size, int axis) {
    const double length = last_digits * (keeps_equals_ ? std::abs(number) : size);
    number += is_up(number, axis) ? length : -length;
  }
  bool is_up(double number, int axis) {
    if (keeps_equals_)
      random_.seed(seed_ * 3 + static_cast<std::uint32_t>(axis) +
                   static_cast<std::uint32_t>(std::hash<double>()(number)));
    return (random_() & 1U) != 0;
  }

  bool keeps_equals_;
  std::uint32_t seed_;
  std::mt19937 random_;
};

/// The lecture's formulas, for a ray that each shape meets where its own last digits put it.
struct RoundedTable : textbook::FormulaTable<Quad> {
  std::uint32_t seed = 0;

  // These hide the entries of the table.
  std::optional<Quad> intersect_sphere(const Ray<Quad>& ray, const Vec3<Quad>& center, Quad radius,
                                       bool starts_on_it) const {
    return formulas::intersect_sphere(rounded(ray, center, radius), center, radius, starts_on_it);
  }
  std::optional<FaceHit<Quad>> intersect_box(const Ray<Quad>& ray, const Corners<Quad>& box,
                                             Face start) const {
    return formulas::intersect_box(rounded(ray, box.min, glm::length(box.max - box.min)), box, start);
  }

 private:
  Ray<Quad> rounded(const Ray<Quad>& ray, const Vec3<Quad>& place, Quad size) const {
    const Vec3d origin(ray.origin), direction(ray.direction), of_shape(place);
    const double length =
        last_digits * std::max({size_of(origin), size_of(of_shape), static_cast<double>(size)});
    Ray<Quad> moved = ray;
    // In half of the patterns it passes by what lies within so little: the second face of an edge that it
    // enters.
    if (seed % 2 != 0) moved.t_min = std::max(ray.t_min, 64 * Quad(length) / glm::length(ray.direction));
    std::uint64_t meeting = seed;
    for (int axis = 0; axis < 3; ++axis)
      meeting = mixed(mixed(mixed(meeting, origin[axis]), direction[axis]), of_shape[axis]);
    meeting = mixed(meeting, static_cast<double>(size));
    for (int axis = 0; axis < 3; ++axis) moved.origin[axis] += (meeting >> axis & 1U) != 0 ? length : -length;
    return moved;
  }
  /// The finalizer of MurmurHash3 (Appleby, public domain).
  static std::uint64_t mixed(std::uint64_t hash, double number) {
    hash ^= std::bit_cast<std::uint64_t>(number);
    hash = (hash ^ hash >> 33U) * 0xff51afd7ed558ccdU;
    hash = (hash ^ hash >> 33U) * 0xc4ceb9fe1a85ec53U;
    return hash ^ hash >> 33U;
  }
};

struct RoundedFormulas {
  const RoundedTable* operator->() const { return &table; }
  RoundedTable table;
};

bool eye_is_on_glass(const Scene& scene, const Camera& camera) {
  const CameraPose<double> pose = pose_of<double>(camera);
  return DielectricsAroundEye<double>(scene, pose.eye, pose.direction).is_on_surface();
}

}  // namespace

Scene with_other_last_digits(const Scene& scene, int pattern) {
  Scene moved = keeps_equals(pattern) ? scene : attribution::with_instances_apart(scene);
  Mover mover(pattern, static_cast<std::uint32_t>(pattern) + 1);
  for (Shape& shape : moved.shapes) {
    std::visit(mover, shape.geometry);
    for (TransformStep& step : shape.transform) std::visit(mover, step);
  }
  for (Light& light : moved.lights) mover.move(light.position);
  return moved;
}

Camera with_other_last_digits(const Camera& camera, int pattern) {
  Camera moved = camera;
  // Not as the first shape is moved, unless its numbers are equal and are to stay so.
  Mover mover(pattern, static_cast<std::uint32_t>(keeps_equals(pattern) ? pattern : ~pattern) + 1);
  mover.move(moved.eye);
  mover.move(moved.direction);
  mover.move(moved.up);
  mover.move(moved.fov_x_degrees);
  for (TransformStep& step : moved.transform) std::visit(mover, step);
  return moved;
}

attribution::Colour to_colour(const Rgb<Quad>& c) {
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
}

bool Answers::is_decided(double tolerance) const {
  return comparison::is_within(least.data(), most.data(), tolerance) &&
         comparison::is_within(most.data(), least.data(), tolerance);
}

bool Answers::allow(const float* value, double tolerance) const {
  attribution::Colour nearest{};
  for (std::size_t c = 0; c < nearest.size(); ++c) nearest[c] = std::clamp(value[c], least[c], most[c]);
  return comparison::is_within(nearest.data(), value, tolerance);
}

void Answers::include(const attribution::Colour& colour) {
  for (std::size_t c = 0; c < colour.size(); ++c) {
    least[c] = std::min(least[c], colour[c]);
    most[c] = std::max(most[c], colour[c]);
  }
}

class Oracle::View {
 public:
  virtual ~View() = default;
  virtual std::optional<Rgb<Quad>> at(int x, int y) const = 0;
};

template <class Formulas>
class Oracle::ViewBy final : public View {
 public:
  ViewBy(Scene scene, const Camera& camera, const Oracle& of, const Formulas& formulas)
      : scene_(std::move(scene)),
        world_(scene_, formulas),
        budget_(world_.instances(), of.work_),
        tracer_(world_, camera, of.shot_.width, of.shot_.height, of.shot_.options, budget_) {
    of.work_.spend(textbook::units_of_world<Quad>(scene_));
  }

  std::optional<Rgb<Quad>> at(int x, int y) const override {
    const Rgb<Quad> colour = tracer_.raycast(x, y);
    if (budget_.take_is_cut()) return std::nullopt;
    return colour;
  }

 private:
  Scene scene_;
  textbook::World<Quad, Formulas> world_;
  textbook::RayBudget<Quad> budget_;
  textbook::Tracer<Quad, Formulas, textbook::RayBudget<Quad>> tracer_;
};

Oracle::Oracle(const Shot& shot, textbook::Work& work)
    : shot_(shot),
      work_(work),
      as_written_(std::make_unique<ViewBy<textbook::LectureFormulas<Quad>>>(
          shot.scene, shot.camera, *this, textbook::LectureFormulas<Quad>{})),
      rounds_(!eye_is_on_glass(shot.scene, shot.camera)),
      moved_(patterns + rounded_patterns) {}

Oracle::~Oracle() = default;

std::optional<Rgb<Quad>> Oracle::colour(int x, int y) const { return as_written_->at(x, y); }

std::optional<Rgb<Quad>> Oracle::colour_when_moved(int x, int y, int pattern) const {
  auto& view = moved_[static_cast<std::size_t>(pattern)];
  if (!view) view = moved_view(pattern);
  return view->at(x, y);
}

std::unique_ptr<Oracle::View> Oracle::moved_view(int pattern) const {
  const bool is_rounded = pattern >= patterns;
  const int way = is_rounded ? (pattern - patterns) % free_patterns : pattern;
  Scene scene = with_other_last_digits(shot_.scene, way);
  const Camera camera = with_other_last_digits(shot_.camera, way);
  if (!is_rounded) {
    return std::make_unique<ViewBy<textbook::LectureFormulas<Quad>>>(std::move(scene), camera, *this,
                                                                     textbook::LectureFormulas<Quad>{});
  }
  RoundedFormulas formulas;
  formulas.table.seed = static_cast<std::uint32_t>(pattern);
  return std::make_unique<ViewBy<RoundedFormulas>>(std::move(scene), camera, *this, formulas);
}

std::optional<Answers> Oracle::answers(int x, int y) const {
  const auto first = colour(x, y);
  if (!first) return std::nullopt;
  Answers answers{to_colour(*first), to_colour(*first)};
  for (int pattern = 0; pattern < patterns; ++pattern) {
    const auto moved = colour_when_moved(x, y, pattern);
    if (!moved || work_.is_over()) return std::nullopt;
    answers.include(to_colour(*moved));
  }
  return answers;
}

}  // namespace plumb::truth
