#include "references/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <utility>

#include "references/diagnosis/brightness.hpp"
#include "references/diagnosis/by_geometry.hpp"
#include "references/diagnosis/diagnostician.hpp"
#include "references/diagnosis/excluded.hpp"
#include "references/diagnosis/search.hpp"

namespace plumb::diagnosis {

const char* to_string(PictureVerdict verdict) {
  switch (verdict) {
    case PictureVerdict::right:
      return "right";
    case PictureVerdict::right_apart:
      return "right_apart";
    case PictureVerdict::faults:
      return "faults";
    case PictureVerdict::unexplained:
      break;
  }
  return "unexplained";
}

namespace {

/// Of faults that give the same picture, what is simply missing comes first, then what more tracers have.
bool is_likelier(const faults::Fault* a, const faults::Fault* b) {
  constexpr int missing = 38;  // number in the catalogue
  const bool a_is_missing = a->catalogue == missing, b_is_missing = b->catalogue == missing;
  return a_is_missing != b_is_missing ? a_is_missing : count_of(*a) > count_of(*b);
}

void put_the_likeliest_first(FoundFault& found) {
  std::vector<const faults::Fault*> all{found.fault};
  all.insert(all.end(), found.alike.begin(), found.alike.end());
  std::ranges::stable_sort(all, &is_likelier);
  found.fault = all.front();
  found.alike = {all.begin() + 1, all.end()};
}

/// Says of a picture that is explained to the last pixel that the rest is right, and what its tracer does not
/// have.
Diagnosis with_what_is_certain(const Evidence& evidence, Diagnosis diagnosis) {
  const bool is_known = diagnosis.verdict != PictureVerdict::unexplained && diagnosis.explains_all();
  if (is_known) diagnosis.certain = {Certainty::right, Certainty::right, Certainty::right};
  for (FoundFault& found : diagnosis.faults) put_the_likeliest_first(found);
  tell_what_is_wrong(diagnosis);
  diagnosis.excluded = excluded_by(evidence, diagnosis);
  return diagnosis;
}

}  // namespace

Diagnosis diagnose(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen, std::optional<double> tolerance) {
  Evidence evidence(scene, camera, job, seen, tolerance);
  Diagnostician diagnostician(evidence, seen);
  if (auto simple = diagnostician.without_search()) return with_what_is_certain(evidence, std::move(*simple));
  std::optional<Diagnosis> brighter = right_but_for_brightness(evidence, seen, tolerance);
  // No fault changes a background, nor makes black another level. The rest may have a fault as its cause.
  if (brighter && (scene.background != Rgbd(0) || brighter->habits.front().id == "levels"))
    return with_what_is_certain(evidence, std::move(*brighter));
  std::optional<ByGeometry> by_geometry;
  if (auto geometry = geometry_of(scene, camera, job, seen)) {
    by_geometry.emplace(evidence, seen, tolerance, std::move(*geometry));
    if (auto found = by_geometry->with_background_of_its_own())
      return with_what_is_certain(evidence, std::move(*found));
  }
  Diagnosis by_colours = diagnostician.with_search(evidence);
  const bool is_told = by_colours.verdict == PictureVerdict::right_apart ||
                       (by_colours.verdict == PictureVerdict::faults && by_colours.explains_all());
  if (!is_told && brighter) return with_what_is_certain(evidence, std::move(*brighter));
  if (!is_told && by_geometry) by_colours = by_geometry->completed(std::move(by_colours));
  return with_what_is_certain(evidence, std::move(by_colours));
}

}  // namespace plumb::diagnosis
