#include "references/renderers/baseline.hpp"

#include "exporters/povray.hpp"

namespace plumb::references {
namespace {

/// That of the space in which a scene spans about 1e4 units.
double extent_of(const Scene& scene, const Camera& camera) {
  return 1e4 / exporters::export_space(scene, camera).scale;
}

}  // namespace

const Resolution& baseline_resolution() {
  static constexpr Resolution resolution{
      .extent = &extent_of,
      .step = 1e-12,  // because only roundings of double differ
      .steps_to_blocker = 10,
      // What is told apart in pictures whose rays part needs no such steps: these are as for any reference.
      .touched_edge = 1e-7,
      .one_place = 1e-6,
      .told_apart = 2.5e-8,
      .shadow = 2e-7,
      .is_of_plumb = true};
  return resolution;
}

}  // namespace plumb::references
