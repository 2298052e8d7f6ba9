#include "references/attribution/shapes_that_take_part.hpp"

#include <algorithm>
#include <map>

#include "tracer/scene/hierarchy.hpp"

namespace plumb::attribution {
namespace {

constexpr int patterns_of_one = 6;        // of a single shape, to find out whether it takes part
constexpr std::size_t pixels_named = 64;  // the shapes are looked for in so many pixels

using Meetings = std::map<ShapeId, std::vector<const ProvenPixel*>>;

void add_met(const RayNode& node, const std::vector<ShapeId>& of_instance, std::set<ShapeId>& met) {
  if (!node.meeting) return;
  met.insert(node.meeting->shape);
  for (const auto& light : node.meeting->lights) {
    const auto blocker = static_cast<std::size_t>(light.blocker.surface.instance);
    if (light.counts && blocker < of_instance.size()) met.insert(of_instance[blocker]);
  }
  for (const RayNode& child : node.children) add_met(child, of_instance, met);
}

/// The shapes that the rays of these pixels meet, moved or not, and what hides lights from them.
Meetings met_by(const Inquiry& inquiry, const std::vector<const ProvenPixel*>& proven) {
  std::vector<ShapeId> of_instance;
  for_each_instance(inquiry.scene(),
                    [&](const Instance& instance) { of_instance.push_back(instance.shape); });
  Meetings meetings;
  for (const ProvenPixel* p : proven) {
    std::set<ShapeId> met;
    for (const int pattern : {no_pattern, p->as_test, p->as_reference})
      add_met(inquiry.tree(pattern, *p->pixel), of_instance, met);
    for (const ShapeId id : met) meetings[id].push_back(p);
  }
  return meetings;
}

/// With many shapes, of the first that are tried.
template <class Unmoved>
std::set<ShapeId> shapes_that_change(const Inquiry& inquiry, const Meetings& meetings,
                                     const PerturbedFormulas& formulas, const Unmoved& unmoved_of,
                                     textbook::Work& work) {
  const AttributionJob& job = inquiry.job();
  std::set<ShapeId> found;
  for (const auto& [id, pixels] : meetings) {
    for (int i = 0; i < patterns_of_one && !found.contains(id) && !work.is_over(); ++i) {
      const PixelTracer moved(inquiry.perturbation().with_one_moved(id, i), job, job.shot.options, work,
                              formulas);
      const bool changes = std::any_of(pixels.begin(), pixels.end(), [&](const ProvenPixel* p) {
        const std::optional<Colour> unmoved = unmoved_of(*p);
        const std::optional<Colour> outcome = moved.at(*p->pixel);
        return unmoved && outcome && !comparison::is_within(unmoved->data(), outcome->data(), job.tolerance);
      });
      if (changes) found.insert(id);
    }
  }
  return found;
}

std::vector<const ProvenPixel*> sample_of(const std::vector<ProvenPixel>& proven) {
  std::vector<const ProvenPixel*> sample;
  const std::size_t stride = std::max<std::size_t>(1, proven.size() / pixels_named);
  for (std::size_t i = 0; i < proven.size(); i += stride) sample.push_back(&proven[i]);
  return sample;
}

}  // namespace

std::set<ShapeId> shapes_that_take_part(const Inquiry& inquiry, const std::vector<ProvenPixel>& proven) {
  const AttributionJob& job = inquiry.job();
  const Meetings meetings = met_by(inquiry, sample_of(proven));
  textbook::Work work(job.work / 5);
  std::set<ShapeId> found = shapes_that_change(
      inquiry, meetings, {}, [](const ProvenPixel& p) { return std::optional(p.unmoved); }, work);
  if (!found.empty() || meetings.empty()) return found;
  // Once more with the reference's shadows: of the two faces at an edge by which a ray leaves a box, one may
  // differ only by whether the box itself hides a light there.
  const PerturbedFormulas shadows = inquiry.perturbation().reference_shadows();
  const PixelTracer still(inquiry.scene(), job, job.shot.options, work, shadows);
  return shapes_that_change(
      inquiry, meetings, shadows, [&](const ProvenPixel& p) { return still.at(*p.pixel); }, work);
}

}  // namespace plumb::attribution
