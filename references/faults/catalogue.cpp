#include <algorithm>
#include <iterator>
#include <limits>

#include "references/faults/areas.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::faults {
namespace {

std::vector<Fault> all_faults() {
  std::vector<Fault> all;
  for (const auto area : {&faults::of_the_camera, &faults::of_the_lighting, &faults::of_the_lights,
                          &faults::of_the_shadows, &faults::of_the_transforms, &faults::of_the_shapes,
                          &faults::of_the_recursion, &faults::of_the_output, &faults::of_what_is_missing}) {
    std::ranges::move(area(), std::back_inserter(all));
  }
  return all;
}

Subject subject_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                     const std::vector<const Fault*>& faults) {
  Subject subject{scene, camera, job, {}};
  for (const Fault* fault : faults) {
    if (fault->apply) fault->apply(subject);
  }
  return subject;
}

void do_after(const std::vector<const Fault*>& faults, Image& image) {
  for (const Fault* fault : faults) {
    if (fault->after) fault->after(image);
  }
}

using LimitedTracer =
    textbook::Tracer<double, textbook::ReplaceableFormulas<double>, textbook::RayBudget<double>>;

}  // namespace

const std::vector<Fault>& fault_catalogue() {
  static const std::vector<Fault> all = all_faults();
  return all;
}

const Fault* find_fault(std::string_view id) {
  const auto& all = fault_catalogue();
  const auto found = std::ranges::find(all, id, &Fault::id);
  return found == all.end() ? nullptr : &*found;
}

const std::vector<Fault>& geometry_families() {
  static const std::vector<Fault> all = [] {
    std::vector<Fault> both = faults::families_of_the_image_plane();
    std::ranges::move(faults::families_of_the_transforms(), std::back_inserter(both));
    return both;
  }();
  return all;
}

const Fault* find_geometry_family(std::string_view id) {
  const auto& all = geometry_families();
  const auto found = std::ranges::find(all, id, &Fault::id);
  return found == all.end() ? nullptr : &*found;
}

const std::vector<Fault>& shading_families() {
  static const std::vector<Fault> all = faults::families_of_the_shading();
  return all;
}

std::vector<float> colours_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                                const std::vector<const Fault*>& faults,
                                const std::vector<PixelPlace>& places, textbook::Work& work) {
  const Subject subject = subject_with(scene, camera, job, faults);
  const textbook::World<double> world(subject.scene, subject.formulas);
  const textbook::RayBudget<double> budget(world.instances(), work);
  const LimitedTracer tracer(world, subject.camera, job.width, job.height, subject.job.options, budget);
  const auto trace = [&](const PixelPlace& place, float* to) {
    const Rgbd colour = tracer.raycast(place.x, place.y);
    const bool is_cut = budget.take_is_cut();
    for (int channel = 0; channel < 3; ++channel)
      to[channel] = is_cut ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(colour[channel]);
  };
  std::vector<float> colours(3 * places.size());
  if (std::ranges::all_of(faults, [](const Fault* fault) { return !fault->after; })) {
    for (std::size_t i = 0; i < places.size(); ++i) trace(places[i], &colours[3 * i]);
    return colours;
  }
  // What faults do to a picture may move pixels, so those where they may come from are traced, too.
  Image image(job.width, job.height);
  for (const auto& [x, y] : places) {
    for (const PixelPlace from :
         {PixelPlace{x, y}, PixelPlace{job.width - 1 - x, y}, PixelPlace{x, job.height - 1 - y},
          PixelPlace{job.width - 1 - x, job.height - 1 - y}})
      trace(from, image.pixel(from.x, from.y));
  }
  do_after(faults, image);
  for (std::size_t i = 0; i < places.size(); ++i)
    std::copy_n(image.pixel(places[i].x, places[i].y), 3, &colours[3 * i]);
  return colours;
}

std::vector<float> layers_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                               const std::vector<const Fault*>& faults,
                               const std::vector<textbook::Layer>& layers,
                               const std::vector<PixelPlace>& places) {
  const Subject subject = subject_with(scene, camera, job, faults);
  return textbook::layers_at(subject.scene, subject.camera, subject.job, layers, subject.formulas, places);
}

Image render_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                  const std::vector<const Fault*>& faults) {
  const Subject subject = subject_with(scene, camera, job, faults);
  const textbook::World<double> world(subject.scene, subject.formulas);
  const textbook::Tracer<double> tracer(world, subject.camera, subject.job.width, subject.job.height,
                                        subject.job.options);
  Image image = textbook::render_rows(tracer, subject.job);
  do_after(faults, image);
  return image;
}

}  // namespace plumb::faults
