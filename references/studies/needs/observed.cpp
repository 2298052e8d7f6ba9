#include "references/studies/needs/observed.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include "tracer/scene/hierarchy.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/sampled_pixels.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::studies {
namespace {

using textbook::RayKind;
using Media = std::vector<textbook::InstanceId>;

/// About two seconds of a machine of 2023.
constexpr double most_units = 1e8;

struct OpenRay {
  RayKind kind;
  int depth;
  Media inside;
  textbook::InstanceId met = textbook::no_instance;
  const textbook::Material<double>* material = nullptr;
  bool is_black = false;
};

/// What is counted for a piece of the picture.
struct Notes {
  const Scene& scene;
  textbook::RayBudget<double> budget;
  Media around_the_eye;
  Observed counts{};
  std::map<textbook::InstanceId, std::uint64_t> blockers{};
  std::vector<OpenRay> open{};  // from the camera ray to the one that is being traced
};

/// Returns what a ray is inside of: at a surface it enters or leaves.
Media media_of(RayKind kind, const Notes& notes) {
  if (kind == RayKind::camera) return notes.around_the_eye;
  Media inside = notes.open.back().inside;
  if (kind != RayKind::refracted && kind != RayKind::unbent) return inside;
  const auto known = std::find(inside.begin(), inside.end(), notes.open.back().met);
  if (known == inside.end())
    inside.push_back(notes.open.back().met);
  else
    inside.erase(known);
  return inside;
}

class Probe {
 public:
  explicit Probe(Notes& notes) : notes_(&notes) {}

  bool ray_begins(RayKind kind, const Ray<double>& ray, int depth) const {
    if (!notes_->budget.ray_begins(kind, ray, depth)) return false;
    notes_->open.push_back({kind, depth, media_of(kind, *notes_)});
    return true;
  }
  void is_black_at_depth_limit() const { notes_->open.back().is_black = true; }

  void meets(const textbook::Hit<double>& hit, const textbook::Surface<double>& surface, const Vec3d&,
             const Vec3d&) const {
    OpenRay& ray = notes_->open.back();
    ray.met = hit.surface.instance;
    ray.material = surface.material;
    Touches& touches = notes_->counts.shapes[surface.shape];
    ++(ray.kind == RayKind::camera ? touches.camera : touches.secondary);
    notes_->counts.ambient += notes_->scene.ambient * surface.material->ka != Rgbd(0);
  }

  void is_lit_by(std::size_t light, const textbook::LightSeen<double>& seen) const {
    notes_->budget.is_lit_by(light, seen);
    if (!seen.counts) return;
    Observed& counts = notes_->counts;
    ++counts.shadow_rays;
    counts.shadows += seen.delta == Rgbd(0);
    if (seen.blocker.surface.instance != textbook::no_instance)
      ++notes_->blockers[seen.blocker.surface.instance];
    const textbook::Material<double>& material = *notes_->open.back().material;
    const Rgbd arriving = seen.delta * notes_->scene.lights[light].intensity();
    const bool is_diffuse = arriving * material.kd != Rgbd(0);
    const bool is_specular = seen.specular_factor > 0 && arriving * material.ks != Rgbd(0);
    counts.diffuse += is_diffuse;
    counts.specular += is_specular;
    counts.lights[light] += is_diffuse || is_specular;
  }

  void ray_ends(const Rgbd&) const {
    const OpenRay& ray = notes_->open.back();
    Observed& counts = notes_->counts;
    if (ray.is_black) {
      ++counts.black_at_limit;
    } else {
      ++counts.rays.at(static_cast<std::size_t>(ray.kind));
      counts.background += ray.met == textbook::no_instance;
      counts.nested += ray.inside.size() > 1;
      counts.deepest = std::max(counts.deepest, ray.depth);
    }
    notes_->open.pop_back();
  }

 private:
  Notes* notes_;
};

using Formulas = textbook::LectureFormulas<double>;
using World = textbook::World<double, Formulas>;

Observed empty_for(const Scene& scene) {
  Observed counts;
  counts.shapes.resize(scene.shapes.size());
  counts.lights.resize(scene.lights.size());
  return counts;
}

/// Traces the pixels begin..end of the order.
Notes noted(const Scene& scene, const World& world, const Camera& camera, const RenderJob& job,
            const std::vector<PixelPlace>& order, std::size_t begin, std::size_t end, textbook::Work& work) {
  Notes notes{scene, {world.instances(), work}, {}, empty_for(scene)};
  const DielectricsAroundEye<double> around = world.dielectrics_around(pose_of<double>(camera));
  for (const EnclosingDielectric& d : around.ahead()) notes.around_the_eye.push_back(d.instance);
  const textbook::Tracer<double, Formulas, Probe> tracer(world, camera, job.width, job.height, job.options,
                                                         Probe(notes));
  for (std::size_t i = begin; i < end; ++i) {
    tracer.raycast(order[i].x, order[i].y);
    notes.counts.cut += notes.budget.take_is_cut();
  }
  const InstanceShapes shape_of(scene);
  for (const auto& [instance, times] : notes.blockers)
    notes.counts.shapes[shape_of.at(instance)].blocked += times;
  return notes;
}

}  // namespace

void Observed::add(const Observed& o) {
  cut += o.cut;
  for (std::size_t i = 0; i < rays.size(); ++i) rays.at(i) += o.rays.at(i);
  background += o.background;
  black_at_limit += o.black_at_limit;
  deepest = std::max(deepest, o.deepest);
  nested += o.nested;
  ambient += o.ambient;
  diffuse += o.diffuse;
  specular += o.specular;
  shadow_rays += o.shadow_rays;
  shadows += o.shadows;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    shapes[i].camera += o.shapes[i].camera;
    shapes[i].secondary += o.shapes[i].secondary;
    shapes[i].blocked += o.shapes[i].blocked;
  }
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i] += o.lights[i];
}

Observed observe(const Scene& scene, const Camera& camera, const RenderJob& job) {
  const World world(scene, {});
  // No pixel costs less than its camera ray, so that no more of them are looked at, but for a last round.
  constexpr std::size_t pixels_of_round = 512;
  const std::vector<PixelPlace> order = textbook::spread_pixels(
      job.width, job.height,
      static_cast<std::size_t>(most_units / textbook::units_of_ray<double>(world.instances())) +
          pixels_of_round);
  Observed all = empty_for(scene);
  std::mutex mutex;
  textbook::Work work(most_units);
  const textbook::Looking looking{work, textbook::threads_for(job), job.progress};
  const auto look = [&](std::size_t begin, std::size_t end, textbook::Work& of_piece) {
    const Notes notes = noted(scene, world, camera, job, order, begin, end, of_piece);
    const std::lock_guard lock(mutex);
    all.add(notes.counts);
  };
  all.looked_at = textbook::look_at(order.size(), looking, look);
  all.pixels = static_cast<std::size_t>(job.width) * static_cast<std::size_t>(job.height);
  return all;
}

}  // namespace plumb::studies
