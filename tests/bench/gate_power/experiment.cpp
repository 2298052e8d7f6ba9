#include "tests/bench/gate_power/experiment.hpp"

#include <algorithm>
#include <cmath>

#include "tracer/image/encode.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::gate_power {
namespace {

using faults::Fault;
using faults::fault_catalogue;

Experiment catalogue_fault(std::size_t subject, const Fault& fault) {
  return {subject, std::string(fault.id), true, Made::in_double,
          [&fault](const Subject& s) { return faults::render_with(s.scene, s.camera, s.job, {&fault}); }};
}

/// Off by 0.1 to 5 %, evenly on a logarithmic scale, up or down.
double some_per_cent(std::mt19937& random) {
  std::uniform_real_distribution<double> exponent(std::log(0.001), std::log(0.05));
  const double fraction = std::exp(exponent(random));
  return random() % 2 == 0 ? fraction : -fraction;
}

Experiment scene_change(std::size_t subject, const std::string& kind, bool is_fault, Scene scene,
                        Camera camera) {
  return {subject, kind, is_fault, Made::in_double,
          [changed = std::move(scene), from = std::move(camera)](const Subject& s) {
            return textbook::render(changed, from, s.job);
          }};
}

// A formula has no state of its own; each picture is rendered in one thread.
thread_local std::uint32_t jitter_seed = 0;

/// Two numbers from -1e-6 to 1e-6 pixels for each pixel, the same every time.
Vec2<double> jittered(int x, int y, int width, int height) {
  std::mt19937 random(jitter_seed + static_cast<std::uint32_t>(y * width + x));
  std::uniform_real_distribution<double> offset(-1e-6, 1e-6);
  const double right = offset(random) / width;
  const double up = offset(random) / width;
  return formulas::image_plane_point<double>(x, y, width, height) + Vec2<double>(right, up);
}

Image with_jitter(const Subject& s, std::uint32_t seed) {
  jitter_seed = seed;
  textbook::FormulaTable<double> table;
  table.image_plane_point = &jittered;
  const textbook::World<double> world(s.scene, table);
  return textbook::render_rows(
      textbook::Tracer<double>(world, s.camera, s.job.width, s.job.height, s.job.options), s.job);
}

Experiment of_job(std::size_t subject, const std::string& kind, Made made, textbook::RealType real,
                  int threads) {
  return {subject, kind, false, made, [real, threads](const Subject& s) {
            textbook::RenderJob job = s.job;
            job.real = real;
            job.threads = threads;
            return textbook::render(s.scene, s.camera, job);
          }};
}

/// The whole world, with its lights and its camera, after one more step.
Experiment moved_as_a_whole(std::size_t index, const Subject& s, const std::string& kind,
                            const TransformStep& step) {
  Scene scene = s.scene;
  Camera camera = s.camera;
  const Mat4<double> m = transform_of<double>({step}).matrix;
  for (const ShapeId root : scene.roots()) scene.shapes[root].transform.push_back(step);
  for (Light& light : scene.lights) light.position = formulas::transform_point(m, light.position);
  camera.transform.push_back(step);
  return scene_change(index, kind, false, std::move(scene), std::move(camera));
}

Experiment of_8_bits(std::size_t subject, bool rounds) {
  return {subject, rounds ? "8 bits, rounded" : "8 bits, truncated", false,
          rounds ? Made::bits8_rounded : Made::bits8_truncated,
          [rounds](const Subject& s) { return decoded_8_bits(s.right, rounds); }};
}

}  // namespace

Image decoded_8_bits(const Image& image, bool rounds) {
  Image held = image;
  for (float& c : held.rgb) {
    const auto byte = truncated_to_8_bits(rounds ? c + 0.5F / 255 : c);
    c = static_cast<float>(byte) / 255;
  }
  return held;
}

std::vector<Experiment> fault_experiments(const std::vector<Subject>& subjects, std::mt19937& random) {
  std::vector<Experiment> all;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    for (const Fault& fault : fault_catalogue()) all.push_back(catalogue_fault(i, fault));
    for (const Parameter& parameter : parameters()) {
      Scene scene = subjects[i].scene;
      Camera camera = subjects[i].camera;
      if (parameter.change(scene, camera, some_per_cent(random), random)) {
        all.push_back(scene_change(i, std::string("parameter ") + parameter.name, true, std::move(scene),
                                   std::move(camera)));
      }
    }
  }
  return all;
}

std::vector<Experiment> benign_experiments(const std::vector<Subject>& subjects, std::mt19937& random) {
  using textbook::RealType;
  std::uniform_real_distribution<double> coordinate(-10, 10);
  const auto vector = [&] { return Vec3d(coordinate(random), coordinate(random), coordinate(random)); };
  std::vector<Experiment> all;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const std::uint32_t seed = static_cast<std::uint32_t>(random());
    all.push_back({i, "samples within 1e-6 pixels", false, Made::sampled_nearby,
                   [seed](const Subject& s) { return with_jitter(s, seed); }});
    all.push_back(of_job(i, "float", Made::in_float, RealType::float32, 1));
    all.push_back(of_job(i, "long double", Made::in_double, RealType::long_double, 1));
    all.push_back(of_job(i, "three threads", Made::in_double, RealType::float64, 3));
    all.push_back(moved_as_a_whole(i, subjects[i], "moved as a whole", Translate{vector()}));
    all.push_back(
        moved_as_a_whole(i, subjects[i], "turned as a whole", Rotate{18 * coordinate(random), vector()}));
    const double factor = std::exp(coordinate(random) / 3);
    all.push_back(moved_as_a_whole(i, subjects[i], "scaled as a whole", Scale{Vec3d(factor)}));
    all.push_back(of_8_bits(i, true));
    all.push_back(of_8_bits(i, false));
  }
  return all;
}

}  // namespace plumb::gate_power
