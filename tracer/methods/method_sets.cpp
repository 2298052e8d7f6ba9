#include "tracer/methods/method_sets.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tracer/formulas/quad.hpp"
#include "tracer/methods/box.hpp"
#include "tracer/methods/sphere.hpp"
#include "tracer/methods/start.hpp"
#include "tracer/methods/transform.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::methods {
namespace {

template <class Real>
using Table = textbook::FormulaTable<Real>;

/// Makes shapes forget where a ray starts, so that only its start or an epsilon keeps it off its surface.
template <class Real>
void forget_surfaces(Table<Real>& table) {
  table.is_ahead = &methods::ahead_of_zero<Real>;
  table.intersect_sphere = &methods::sphere_unaware<Real, &formulas::intersect_sphere<Real>>;
  table.intersect_box = &methods::box_unaware<Real, &formulas::intersect_box<Real>>;
}

template <class Real, auto origin>
void start_at(Table<Real>& table) {
  forget_surfaces(table);
  table.secondary_origin = origin;
  table.shadow_ray = &methods::shadow_from<Real, origin>;
}

template <class Real>
bool replace_shapes(std::string_view id, Table<Real>& table) {
  if (id == "sphere-naive")
    table.intersect_sphere = &methods::sphere_naive<Real>;
  else if (id == "sphere-kahan")
    table.intersect_sphere = &methods::sphere_kahan<Real>;
  else if (id == "sphere-haines")
    table.intersect_sphere = &methods::sphere_haines<Real>;
  else if (id == "sphere-geometric")
    table.intersect_sphere = &methods::sphere_geometric<Real>;
  else if (id == "box-six-planes")
    table.intersect_box = &methods::box_six_planes<Real>;
  else if (id == "box-front-faces")
    table.intersect_box = &methods::box_front_faces<Real>;
  else if (id == "box-kay-kajiya")
    table.intersect_box = &methods::box_kay_kajiya<Real>;
  else if (id == "box-williams")
    table.intersect_box = &methods::box_williams<Real>;
  else if (id == "box-ize")
    table.intersect_box = &methods::box_ize<Real>;
  else
    return false;
  return true;
}

template <class Real>
bool replace_rest(std::string_view id, Table<Real>& table) {
  if (id == "start-nothing") {
    start_at<Real, &formulas::secondary_origin<Real>>(table);
  } else if (id == "start-epsilon") {
    start_at<Real, &methods::epsilon_ahead<Real>>(table);
  } else if (id == "start-normal-offset") {
    start_at<Real, &methods::normal_offset<Real>>(table);
  } else if (id == "start-waechter-binder") {
    start_at<Real, &methods::waechter_binder<Real>>(table);
  } else if (id == "start-error-bound") {
    start_at<Real, &methods::error_bound<Real>>(table);
  } else if (id == "normal-as-it-is") {
    table.unit_normal = &methods::normal_as_it_is<Real>;
  } else if (id == "inverse-of-product") {
    table.transform_of = &methods::inverse_of_product<Real>;
  } else {
    return id == "lecture";
  }
  return true;
}

template <class Real>
Image render_in(const MethodSet& set, const Scene& scene, const Camera& camera,
                const textbook::RenderJob& job) {
  Table<Real> table;
  if (!replace_shapes(set.id, table) && !replace_rest(set.id, table))
    throw std::invalid_argument("found method set '" + std::string(set.id) +
                                "', expected one of method_sets()");
  const textbook::ReplaceableFormulas<Real> formulas(table);
  const textbook::World<Real> world(scene, formulas);
  return textbook::render_rows(textbook::Tracer<Real>(world, camera, job.width, job.height, job.options),
                               job);
}

}  // namespace

const std::vector<MethodSet>& method_sets() {
  static const std::vector<MethodSet> sets{
      {"lecture", "the lecture's formulas, evaluated stably; rays know the surface they leave",
       "the lecture"},
      {"sphere-naive", "sphere by (-b -+ sqrt(b^2 - 4ac)) / 2a, as the slide writes it", "the lecture"},
      {"sphere-kahan", "sphere by Kahan's discriminant", "Kahan 2004; Jeannerod, Louvet, Muller 2013"},
      {"sphere-haines", "sphere by the centre's distance from the line",
       "Haines et al., Ray Tracing Gems, 2019, chapter 7"},
      {"sphere-geometric", "sphere by half the chord, squares subtracted", "Haines, in Glassner 1989, 2.2"},
      {"box-six-planes", "box by six planes, each point tested", "the lecture"},
      {"box-front-faces", "box by the faces toward the viewer", "Woo, Graphics Gems, 1990"},
      {"box-kay-kajiya", "box by slabs, divided", "Kay, Kajiya 1986"},
      {"box-williams", "box by slabs and reciprocals", "Williams et al. 2005"},
      {"box-ize", "box by slabs, 2 ulp wider", "Ize 2013"},
      {"start-nothing", "nothing keeps a ray off its own surface", "no source"},
      {"start-epsilon", "t > 1e-4", "common use"},
      {"start-normal-offset", "starts 1e-4 along the normal", "common use"},
      {"start-waechter-binder", "starts 256 ulp along the normal",
       "Waechter, Binder, Ray Tracing Gems, 2019, chapter 6"},
      {"start-error-bound", "starts beyond the point's error bound", "Pharr, Jakob, Humphreys 2023, 6.8"},
      {"normal-as-it-is", "transformed normals are not normalised again", "a common mistake"},
      {"inverse-of-product", "matrices are multiplied, then inverted", "common use"}};
  return sets;
}

const MethodSet* find_method_set(std::string_view id) {
  const auto found = std::find_if(method_sets().begin(), method_sets().end(),
                                  [id](const MethodSet& set) { return set.id == id; });
  return found == method_sets().end() ? nullptr : &*found;
}

Image render_with_methods(const MethodSet& set, const Scene& scene, const Camera& camera,
                          const textbook::RenderJob& job) {
  switch (job.real) {
    case RealType::float32:
      return render_in<float>(set, scene, camera, job);
    case RealType::long_double:
      return render_in<long double>(set, scene, camera, job);
    case RealType::quad:
      return render_in<Quad>(set, scene, camera, job);
    case RealType::float64:
      break;
  }
  return render_in<double>(set, scene, camera, job);
}

}  // namespace plumb::methods
