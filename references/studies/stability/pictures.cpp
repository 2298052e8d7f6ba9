#include "references/studies/stability/pictures.hpp"

#include <stdexcept>

#include "references/report/html/thumbnail.hpp"
#include "references/studies/stability/embree.hpp"
#include "references/studies/stability/rendered.hpp"
#include "references/studies/stability/worlds.hpp"
#include "tracer/methods/method_sets.hpp"
#include "tracer/methods/start.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::studies::stability {
namespace {

RealType real_of(const std::string& name) {
  if (name == "float") return RealType::float32;
  return name == "double" ? RealType::float64 : RealType::long_double;
}

textbook::RenderJob job_of(const World& world, RealType real) {
  textbook::RenderJob job;
  job.width = job.height = 64;
  job.options.depth = world.depth;
  job.real = real;
  job.threads = 1;
  return job;
}

/// The lecture's pipeline with Embree's intersections. Where `unaware`, all that is ahead of t = 0 counts.
Image by_embree(const World& world, bool unaware) {
  textbook::FormulaTable<float> table;
  table.intersect_sphere = &embree_sphere;
  table.intersect_box = &embree_box;
  if (unaware) table.is_ahead = &methods::ahead_of_zero<float>;
  const textbook::ReplaceableFormulas<float> formulas(table);
  const textbook::World<float> shapes(world.scene, formulas);
  const textbook::RenderJob job = job_of(world, RealType::float32);
  return textbook::render_rows(
      textbook::Tracer<float>(shapes, world.camera, job.width, job.height, job.options), job);
}

std::optional<Image> seen_by(const Row& row, const World& world) {
  const textbook::RenderJob job = job_of(world, real_of(row.real));
  if (row.method.starts_with("povray")) {
    const auto povray = row.method == "povray-blocks" ? by_povray_in_other_blocks()
                                                      : by_povray(row.method == "povray-rescaled");
    return picture_of(*povray, world, job.width);
  }
  if (row.method.starts_with("embree")) return by_embree(world, row.method == "embree-secondary");
  const methods::MethodSet* const set =
      methods::find_method_set(row.method == "start-id" ? "lecture" : row.method);
  if (set == nullptr) return std::nullopt;
  return methods::render_with_methods(*set, world.scene, world.camera, job);
}

/// Embree's own instances are not in its picture.
bool is_seen(const Condition& condition, const Row& row) {
  const bool places =
      condition.name == "flattening" || condition.name == "condition-number" || condition.name == "nesting";
  return !(places && row.method == "embree");
}

}  // namespace

double first_break(const Row& row) {
  const Breaks& b = row.breaks;
  std::optional<double> first;
  for (const auto& at : {b.missed, b.self_shadow, b.percent}) {
    if (at && (!first || *at < *first)) first = at;
  }
  if (!first) first = b.e6 ? b.e6 : b.ulp16;
  return first.value();
}

std::optional<FailurePicture> failure_picture(const Condition& condition, const Row& row) {
  if (!row.breaks.any() || !is_seen(condition, row)) return std::nullopt;
  const double value = 1.5 * first_break(row);
  std::optional<World> world = world_of(condition.name, value);
  if (!world) world = close_up_of(condition.name, value);
  if (!world) return std::nullopt;
  try {
    const std::optional<Image> seen = seen_by(row, *world);
    if (!seen) return std::nullopt;
    const Image truth = textbook::render(world->scene, world->camera, job_of(*world, RealType::quad));
    return FailurePicture{report::thumbnail(*seen), report::error_thumbnail(truth, *seen), {}};
  } catch (const std::runtime_error& error) {  // the failure of some is that they make none
    return FailurePicture{{}, {}, error.what()};
  }
}

}  // namespace plumb::studies::stability
