// The mistakes that people make in their ray tracers. Each is one change of the textbook tracer.
#pragma once

#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "references/comparison/comparison.hpp"
#include "tracer/image/image.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/formula_table.hpp"
#include "tracer/textbook/layers.hpp"
#include "tracer/textbook/ray_budget.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::faults {

/// A render that is still to be done, as faults change it.
struct Subject {
  Scene scene;
  Camera camera;
  textbook::RenderJob job;
  textbook::FormulaTable<double> formulas;
};

/// One mistake. When two faults replace one formula, the later one counts. pixel-corner goes together with
/// the faults of the aspect.
struct Fault {
  std::string_view id;                  ///< lower case, words joined by -
  int catalogue;                        ///< its number in the catalogue of faults of real tracers, 1 to 45
  std::string_view slide;               ///< of the lecture; "Decision" where it is silent
  std::string_view explanation;         ///< one sentence
  std::string_view wrong;               ///< formula
  std::string_view right;               ///< formula
  std::string_view how_common;          ///< "38 of 42" of the tracers whose source was read
  std::string_view shown_by;            ///< a scene of tests/scenes that it changes by much
  std::function<void(Subject&)> apply;  ///< changes a formula, or the scene before the render; may be empty
  std::function<void(Image&)> after;    ///< changes the picture after the render; may be empty
  /// Of a family, the constant of this member; else not a number.
  double value = std::numeric_limits<double>::quiet_NaN();
};

/// Returns all faults, in the order of the catalogue.
const std::vector<Fault>& fault_catalogue();

/// Returns the fault of that id, or null.
const Fault* find_fault(std::string_view id);

/// Returns faults of the camera and of transforms that stand for a family, e.g. a field of view that is
/// always the same. They are told by the geometry of a picture alone; no search over formulas tries them.
const std::vector<Fault>& geometry_families();

/// Returns the family of that id, or null.
const Fault* find_geometry_family(std::string_view id);

/// Returns faults of the shading that have a constant of the program in them, a member for each of its usual
/// values. They have the id of the fault of the catalogue that stands for all of them, or one of their own.
const std::vector<Fault>& shading_families();

/// Renders with all these faults at once, in double whatever the job says. Without any it gives what render()
/// gives. Colours may not be finite.
Image render_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                  const std::vector<const Fault*>& faults);

/// Renders these pixels alone: r g b of each, interleaved. A pixel with more than `most_rays_of_pixel` rays
/// is not a number. Takes its cost from `work`.
std::vector<float> colours_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                                const std::vector<const Fault*>& faults,
                                const std::vector<PixelPlace>& places, textbook::Work& work);

/// Returns layers of these pixels, as textbook::layers_at() does. What faults do to a finished picture is
/// left out.
std::vector<float> layers_with(const Scene& scene, const Camera& camera, const textbook::RenderJob& job,
                               const std::vector<const Fault*>& faults,
                               const std::vector<textbook::Layer>& layers,
                               const std::vector<PixelPlace>& places);

}  // namespace plumb::faults
