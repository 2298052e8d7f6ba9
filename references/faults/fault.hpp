// The mistakes that people make in their ray tracers, each as one change of the textbook tracer.
#pragma once

#include <string_view>
#include <vector>

#include "references/comparison/comparison.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/formula_table.hpp"
#include "tracer/textbook/ray_budget.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::references {

/// A render that is still to be done: what faults change.
struct Subject {
  Scene scene;
  Camera camera;
  textbook::RenderJob job;
  textbook::FormulaTable<double> formulas;
};

/// One mistake. Of two faults that replace the same formula the later one counts; pixel-corner goes together
/// with those of the aspect.
struct Fault {
  std::string_view id;           ///< lower case, words joined by -
  int catalogue;                 ///< its entry in the catalogue of faults of real tracers, 1..45
  std::string_view slide;        ///< of the lecture; "Decision" where it is silent
  std::string_view explanation;  ///< one sentence
  std::string_view wrong;        ///< formula
  std::string_view right;        ///< formula
  std::string_view how_common;   ///< "38 of 42" tracers whose source was read
  std::string_view shown_by;     ///< a scene of tests/scenes that it changes by much
  void (*apply)(Subject&);       ///< a formula, or the scene before the render; may be null
  void (*after)(Image&);         ///< the picture after the render; may be null
};

/// All faults, in the order of the catalogue.
const std::vector<Fault>& fault_catalogue();

/// The fault of that id, or null.
const Fault* find_fault(std::string_view id);

/// Renders with all these faults at once, in double whatever the job says; without any, what render() gives.
/// A fault may give colours that are not finite.
Image render_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                  const std::vector<const Fault*>& faults);

/// The same at these pixels alone: r g b of each, interleaved. A pixel with more than `most_rays_of_pixel`
/// rays is not a number. What it costs is taken from `work`.
std::vector<float> colours_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                                const std::vector<const Fault*>& faults,
                                const std::vector<PixelPlace>& places, textbook::Work& work);

}  // namespace plumb::references
