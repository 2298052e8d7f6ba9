#include "tests/bench/gate_power/resolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "references/comparison/comparison.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::gate_power {
namespace {

constexpr int tries = 48;  // the range of a smooth colour grows little after so many
constexpr int most_tries = 512;
constexpr double smallest_jump = 1e-3;  // no smooth colour changes by more within any of the resolutions
constexpr double most_traces = 4e6;     // a picture that differs as a whole is no matter of rounding

// A formula has no state of its own; each picture is judged in one thread.
thread_local Vec2<double> shift(0);  // of every sample, in pixels

Vec2<double> shifted(int x, int y, int width, int height) {
  return formulas::image_plane_point<double>(x, y, width, height) + shift / static_cast<double>(width);
}

/// The scene with every length moved at random by up to a fraction of itself.
class Scatter {
 public:
  Scatter(double fraction, std::mt19937& random) : fraction_(fraction), random_(random) {}

  void apply(Scene& scene, Camera& camera) {
    for (Shape& shape : scene.shapes) {
      if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
        move(sphere->center);
        sphere->radius *= 1 + fraction_ * some();
      } else if (auto* box = std::get_if<Box>(&shape.geometry)) {
        move(box->min);
        move(box->max);
        box->max = glm::max(box->min, box->max);
      }
      for (TransformStep& step : shape.transform) {
        if (auto* translation = std::get_if<Translate>(&step)) move(translation->by);
      }
    }
    for (Light& light : scene.lights) move(light.position);
    move(camera.eye);
    move(camera.direction);
  }

 private:
  double some() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  void move(Vec3d& v) { v += fraction_ * glm::length(v) * Vec3d(some(), some(), some()); }

  double fraction_;
  std::mt19937& random_;
};

/// The colours that a pixel took on so far.
struct Range {
  PixelPlace place;
  std::array<double, 3> least;
  std::array<double, 3> most;

  void take(const Rgbd& colour) {
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      least[i] = std::min(least[i], colour[c]);
      most[i] = std::max(most[i], colour[c]);
    }
  }

  bool jumps() const {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, most[c] - least[c]);
    return largest > smallest_jump;
  }

  bool contains(const float* colour) const {
    for (std::size_t c = 0; c < 3; ++c) {
      const double slack = most[c] - least[c] + 0x1p-20 * std::max(1.0, most[c]);
      if (!(colour[c] >= least[c] - slack && colour[c] <= most[c] + slack)) return false;
    }
    return true;
  }
};

std::vector<Range> ranges_of_differing(const Subject& s, const Image& given) {
  std::vector<Range> ranges;
  for (const PixelPlace p : comparison::pixels_over(s.right, given, 0)) {
    const float* right = s.right.pixel(p.x, p.y);
    const std::array<double, 3> colour{right[0], right[1], right[2]};
    ranges.push_back({p, colour, colour});
  }
  return ranges;
}

}  // namespace

bool is_within_resolution(const Subject& s, const Image& given, const Resolution& resolution) {
  std::mt19937 random(1);  // any seed: the ranges are to be the same every time
  std::uniform_real_distribution<double> offset(-resolution.samples, resolution.samples);
  textbook::FormulaTable<double> table;
  table.image_plane_point = &shifted;
  std::vector<Range> open = ranges_of_differing(s, given);
  const auto is_settled = [&](const Range& r) { return r.contains(given.pixel(r.place.x, r.place.y)); };
  double traces = 0;
  for (int i = 0; i < most_tries && traces < most_traces; ++i) {
    std::erase_if(open, is_settled);
    if (open.empty()) return true;
    if (i == tries && std::any_of(open.begin(), open.end(), [](const Range& r) { return !r.jumps(); }))
      return false;
    Scene scene = s.scene;
    Camera camera = s.camera;
    Scatter(resolution.lengths, random).apply(scene, camera);
    shift = {offset(random), offset(random)};
    const textbook::World<double> world(scene, table);
    const textbook::Tracer<double> tracer(world, camera, s.job.width, s.job.height, s.job.options);
    for (Range& range : open) range.take(tracer.raycast(range.place.x, range.place.y));
    traces += static_cast<double>(open.size());
  }
  std::erase_if(open, is_settled);
  return open.empty();
}

}  // namespace plumb::gate_power
