#include "references/diagnosis/diagnosis.hpp"

#include <utility>

#include "references/diagnosis/by_geometry.hpp"
#include "references/diagnosis/diagnostician.hpp"

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

/// Says of a picture that is explained to the last pixel that the rest is right.
Diagnosis with_what_is_certain(Diagnosis diagnosis) {
  const bool is_known = diagnosis.verdict != PictureVerdict::unexplained && diagnosis.explains_all();
  if (is_known) diagnosis.certain = {Certainty::right, Certainty::right, Certainty::right};
  tell_what_is_wrong(diagnosis);
  return diagnosis;
}

}  // namespace

Diagnosis diagnose(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                   const ImageFile& seen, std::optional<double> tolerance) {
  Evidence evidence(scene, camera, job, seen, tolerance);
  Diagnostician diagnostician(evidence, seen);
  if (auto simple = diagnostician.without_search()) return with_what_is_certain(std::move(*simple));
  std::optional<ByGeometry> by_geometry;
  if (auto geometry = geometry_of(scene, camera, job, seen)) {
    by_geometry.emplace(evidence, seen, tolerance, std::move(*geometry));
    if (auto found = by_geometry->with_background_of_its_own())
      return with_what_is_certain(std::move(*found));
  }
  Diagnosis by_colours = diagnostician.with_search(evidence);
  const bool is_told = by_colours.verdict == PictureVerdict::right_apart ||
                       (by_colours.verdict == PictureVerdict::faults && by_colours.explains_all());
  if (!is_told && by_geometry) by_colours = by_geometry->completed(std::move(by_colours));
  return with_what_is_certain(std::move(by_colours));
}

}  // namespace plumb::diagnosis
