#include "references/studies/stability/embree.hpp"

#include <cmath>

#include "references/studies/stability/trial.hpp"
#include "tracer/system/module.hpp"

namespace plumb::studies::stability {
namespace {

/// The module's functions, see embree_module.cpp.
struct Embree {
  std::string missing;  ///< why; empty when it is there
  const char* (*version)() = nullptr;
  float (*sphere)(const float*, const float*, const float*, float) = nullptr;
  float (*box)(const float*, const float*, const float*, const float*, int*) = nullptr;
  float (*placed_sphere)(const float*, const float*, const float*) = nullptr;
};

template <class Function>
void find(Function& function, const char* name) {
  function = reinterpret_cast<Function>(module_symbol("plumb_embree.so", name));
}

const Embree& module() {
  static const Embree loaded = [] {
    Embree e;
    try {
      find(e.version, "plumb_embree_version");
      find(e.sphere, "plumb_embree_sphere");
      find(e.box, "plumb_embree_box");
      find(e.placed_sphere, "plumb_embree_placed_sphere");
    } catch (const std::runtime_error& error) {
      e.missing = std::string("Embree 3 cannot be used: ") + error.what() + "; apt-get install libembree3-3";
    }
    return e;
  }();
  return loaded;
}

const Embree& embree() {
  if (!module().missing.empty()) throw Unavailable(module().missing);
  return module();
}

std::optional<float> met(float t) { return std::isfinite(t) ? std::optional(t) : std::nullopt; }

}  // namespace

const std::string& embree_version() {
  static const std::string version = module().missing.empty() ? module().version() : "";
  return version;
}

std::optional<float> embree_sphere(const Ray<float>& ray, const Vec3<float>& center, float radius, bool) {
  return met(embree().sphere(&ray.origin.x, &ray.direction.x, &center.x, radius));
}

std::optional<FaceHit<float>> embree_box(const Ray<float>& ray, const Corners<float>& box, Face) {
  int face = no_face;
  const auto t = met(embree().box(&ray.origin.x, &ray.direction.x, &box.min.x, &box.max.x, &face));
  return t ? std::optional(FaceHit<float>{*t, face}) : std::nullopt;
}

std::optional<float> embree_placed_sphere(const Ray<float>& ray, const Mat4<float>& world_from_object) {
  return met(embree().placed_sphere(&ray.origin.x, &ray.direction.x, &world_from_object[0][0]));
}

}  // namespace plumb::studies::stability
