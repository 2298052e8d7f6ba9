#include <algorithm>
#include <iterator>

#include "references/faults/areas.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::references {
namespace {

std::vector<Fault> all_faults() {
  std::vector<Fault> all;
  for (const auto area : {&faults::of_the_camera, &faults::of_the_lighting, &faults::of_the_lights,
                          &faults::of_the_shadows, &faults::of_the_transforms, &faults::of_the_shapes,
                          &faults::of_the_recursion, &faults::of_the_output}) {
    std::ranges::move(area(), std::back_inserter(all));
  }
  return all;
}

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

Image render_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                  const std::vector<const Fault*>& faults) {
  Subject subject{scene, camera, job, {}};
  for (const Fault* fault : faults) {
    if (fault->apply != nullptr) fault->apply(subject);
  }
  const textbook::World<double> world(subject.scene, subject.formulas);
  const textbook::Tracer<double> tracer(world, subject.camera, subject.job.width, subject.job.height,
                                        subject.job.options);
  Image image = textbook::render_rows(tracer, subject.job);
  for (const Fault* fault : faults) {
    if (fault->after != nullptr) fault->after(image);
  }
  return image;
}

}  // namespace plumb::references
