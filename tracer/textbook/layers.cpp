#include "tracer/textbook/layers.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::textbook {
namespace {

using Formulas = ReplaceableFormulas<double>;

/// What is known of the first ray of a pixel.
struct FirstRay {
  Vec3d direction{0};
  Hit<double> hit{};
  Vec3d point{0};
  Vec3d normal{0};
  std::vector<double> shadow;  ///< of each light
  Rgbd ambient{0}, diffuse{0}, specular{0}, mirror{0}, refraction{0};
};

/// Tells the first ray from those that follow, and takes its terms apart. Copies fill in the same FirstRay.
class Observer {
 public:
  explicit Observer(const World<double, Formulas>& world)
      : world_(&world), f_(&world.formulas()), state_(std::make_shared<State>()) {}

  bool ray_begins(RayKind kind, const Ray<double>& ray, int /*depth*/) const {
    if (state_->open.empty()) {
      state_->first = {};
      state_->first.direction = ray.direction;
      state_->first.shadow.resize(world_->lights().size());
    }
    state_->open.push_back(kind);
    return true;
  }
  void is_black_at_depth_limit() const {}
  void meets(const Hit<double>& hit, const Surface<double>& surface, const Vec3d& point,
             const Vec3d& normal) const {
    if (!is_first()) return;
    FirstRay& first = state_->first;
    first.hit = hit;
    first.point = point;
    first.normal = normal;
    first.ambient = (*f_)->ambient_light(world_->ambient(), surface.material->ka);
    state_->material = surface.material;
  }
  void is_lit_by(std::size_t number, const LightSeen<double>& seen) const {
    if (!is_first()) return;
    FirstRay& first = state_->first;
    if (seen.counts) first.shadow[number] = 1 - (seen.delta.r + seen.delta.g + seen.delta.b) / 3;
    if (seen.delta == Rgbd(0)) return;
    const Material<double>& m = *state_->material;
    const Rgbd arriving = (*f_)->arriving_light(world_->lights()[number].intensity, seen.distance);
    first.diffuse += (*f_)->reflected_intensity(arriving, seen.delta, m.kd, seen.cos_theta, Rgbd(0), 0);
    first.specular +=
        (*f_)->reflected_intensity(arriving, seen.delta, Rgbd(0), 0, m.ks, seen.specular_factor);
  }
  void ray_ends(const Rgbd& colour) const {
    const RayKind kind = state_->open.back();
    state_->open.pop_back();
    if (!is_first()) return;
    FirstRay& first = state_->first;
    const Material<double>& m = *state_->material;
    if (kind == RayKind::mirrored) {
      first.mirror = (*f_)->combined_colour(Rgbd(0), m.mirror, colour, m.transmit, Rgbd(0));
    } else if (kind == RayKind::totally_reflected) {
      first.mirror = (*f_)->colour_at_total_reflection(Rgbd(0), colour);
    } else {
      first.refraction = (*f_)->combined_colour(Rgbd(0), m.mirror, Rgbd(0), m.transmit, colour);
    }
  }

  const FirstRay& first() const { return state_->first; }

 private:
  struct State {
    FirstRay first;
    const Material<double>* material = nullptr;  // of what the first ray meets
    std::vector<RayKind> open;                   // from the first ray to the one that is being traced
  };
  bool is_first() const { return state_->open.size() == 1; }

  const World<double, Formulas>* world_;
  const Formulas* f_;
  std::shared_ptr<State> state_;
};

void append(std::vector<float>& values, std::initializer_list<double> these) {
  for (const double value : these) values.push_back(static_cast<float>(value));
}
void append(std::vector<float>& values, const Vec3d& v) { append(values, {v.x, v.y, v.z}); }

void append(std::vector<float>& values, Layer layer, const FirstRay& first) {
  const bool meets = first.hit.surface.instance != no_instance;
  switch (layer) {
    case Layer::normal:
      return append(values, first.normal);
    case Layer::depth:
      return append(values, {meets ? first.hit.t : 0});
    case Layer::point:
      return append(values, first.point);
    case Layer::object:
      return append(values, {meets ? static_cast<double>(first.hit.surface.instance + 1) : 0});
    case Layer::shadow:
      for (const double share : first.shadow) append(values, {share});
      return;
    case Layer::direction:
      return append(values, first.direction);
    case Layer::ambient:
      return append(values, first.ambient);
    case Layer::diffuse:
      return append(values, first.diffuse);
    case Layer::specular:
      return append(values, first.specular);
    case Layer::mirror:
      return append(values, first.mirror);
    case Layer::refraction:
      return append(values, first.refraction);
  }
}

/// Traces some pixels, in one thread.
std::vector<float> values_at(const World<double, Formulas>& world, const Camera& camera, const RenderJob& job,
                             const std::vector<Layer>& layers, const std::vector<PixelPlace>& places) {
  const Observer observer(world);
  const Tracer<double, Formulas, Observer> tracer(world, camera, job.width, job.height, job.options,
                                                  observer);
  std::vector<float> values;
  for (const PixelPlace& place : places) {
    append(values, tracer.raycast(place.x, place.y));
    for (const Layer layer : layers) append(values, layer, observer.first());
  }
  return values;
}

std::vector<PixelPlace> places_of_row(int y, int width) {
  std::vector<PixelPlace> places;
  for (int x = 0; x < width; ++x) places.push_back({x, y});
  return places;
}

std::vector<std::string> with_suffixes(const std::string& layer,
                                       std::initializer_list<const char*> suffixes) {
  std::vector<std::string> names;
  for (const char* suffix : suffixes) names.push_back(layer + "." + suffix);
  return names;
}

std::vector<std::string> of_each_light(std::size_t lights) {
  std::vector<std::string> names;
  for (std::size_t light = 1; light <= lights; ++light) names.push_back("shadow." + std::to_string(light));
  return names;
}

void refuse_too_many(const RenderJob& job, std::size_t channels) {
  constexpr std::int64_t most = std::int64_t{1} << 28;
  const std::int64_t values = std::int64_t{job.width} * job.height * static_cast<std::int64_t>(channels);
  if (values <= most) return;
  throw std::runtime_error("found " + std::to_string(values) + " values of " + std::to_string(channels) +
                           " channels, expected at most " + std::to_string(most) +
                           "; ask for a smaller picture or for fewer layers");
}

}  // namespace

std::vector<std::string> channels_of(Layer layer, const Scene& scene) {
  switch (layer) {
    case Layer::normal:
      return with_suffixes("normal", {"X", "Y", "Z"});
    case Layer::depth:
      return with_suffixes("depth", {"Z"});
    case Layer::point:
      return with_suffixes("point", {"X", "Y", "Z"});
    case Layer::object:
      return with_suffixes("object", {"id"});
    case Layer::shadow:
      return of_each_light(scene.lights.size());
    case Layer::direction:
      return with_suffixes("direction", {"X", "Y", "Z"});
    case Layer::ambient:
      return with_suffixes("ambient", {"R", "G", "B"});
    case Layer::diffuse:
      return with_suffixes("diffuse", {"R", "G", "B"});
    case Layer::specular:
      return with_suffixes("specular", {"R", "G", "B"});
    case Layer::mirror:
      return with_suffixes("mirror", {"R", "G", "B"});
    case Layer::refraction:
      return with_suffixes("refraction", {"R", "G", "B"});
  }
  return {};
}

ImageFile render_layers(const Scene& scene, const Camera& camera, const RenderJob& job,
                        const std::vector<Layer>& layers) {
  ImageFile picture;
  picture.width = job.width;
  picture.height = job.height;
  picture.contents.channels = {"R", "G", "B"};
  for (const Layer layer : layers)
    std::ranges::copy(channels_of(layer, scene), std::back_inserter(picture.contents.channels));
  const std::size_t channels = picture.contents.channels.size();
  refuse_too_many(job, channels);
  picture.channels = static_cast<int>(channels);
  const std::size_t in_row = channels * static_cast<std::size_t>(job.width);
  picture.values.resize(in_row * static_cast<std::size_t>(job.height));
  const World<double, Formulas> world(scene, Formulas({}));
  for_each_row(job.height, threads_for(job), job.progress, [&](int y) {
    const auto row = values_at(world, camera, job, layers, places_of_row(y, job.width));
    std::ranges::copy(row, picture.values.begin() + static_cast<std::ptrdiff_t>(in_row) * y);
  });
  return picture;
}

std::vector<float> layers_at(const Scene& scene, const Camera& camera, const RenderJob& job,
                             const std::vector<Layer>& layers, const FormulaTable<double>& formulas,
                             const std::vector<PixelPlace>& places) {
  const World<double, Formulas> world(scene, Formulas(formulas));
  return values_at(world, camera, job, layers, places);
}

}  // namespace plumb::textbook
