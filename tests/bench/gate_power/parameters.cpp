// Parameters that can be wrong by some per cent: as when a number is mistyped, or a conversion is slightly
// off.
#include "tests/bench/gate_power/experiment.hpp"

namespace plumb::gate_power {
namespace {

using Random = std::mt19937;

/// An element that the predicate takes, at random; null when there is none.
template <class Element, class Predicate>
Element* any_of(std::vector<Element>& all, Random& random, const Predicate& is_taken) {
  std::vector<Element*> taken;
  for (Element& element : all) {
    if (is_taken(element)) taken.push_back(&element);
  }
  return taken.empty() ? nullptr : taken[random() % taken.size()];
}

/// A unit vector in any direction.
Vec3d direction(Random& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(Vec3d(normal(random), normal(random), normal(random)));
}

template <Rgbd Material::*colour>
bool change_colour(Scene& scene, Camera&, double fraction, Random& random) {
  Material* material =
      any_of(scene.materials, random, [](const Material& m) { return m.*colour != Rgbd(0); });
  if (material != nullptr) material->*colour *= 1 + fraction;
  return material != nullptr;
}

bool change_exponent(Scene& scene, Camera&, double fraction, Random& random) {
  Material* material =
      any_of(scene.materials, random, [](const Material& m) { return m.ks != Rgbd(0) && m.m > 0; });
  if (material != nullptr) material->m *= 1 + fraction;
  return material != nullptr;
}

bool change_eta(Scene& scene, Camera&, double fraction, Random& random) {
  Material* material = any_of(scene.materials, random, [](const Material& m) { return m.transmits(); });
  if (material != nullptr) material->eta *= 1 + fraction;
  return material != nullptr;
}

Light* any_light(Scene& scene, Random& random) {
  return any_of(scene.lights, random, [](const Light&) { return true; });
}

bool move_light(Scene& scene, Camera& camera, double fraction, Random& random) {
  Light* light = any_light(scene, random);
  if (light != nullptr)
    light->position += fraction * glm::length(light->position - camera.eye) * direction(random);
  return light != nullptr;
}

bool change_brightness(Scene& scene, Camera&, double fraction, Random& random) {
  Light* light = any_light(scene, random);
  if (light != nullptr) light->brightness *= 1 + fraction;
  return light != nullptr;
}

bool change_light_colour(Scene& scene, Camera&, double fraction, Random& random) {
  Light* light = any_light(scene, random);
  if (light != nullptr) light->color[static_cast<int>(random() % 3)] *= 1 + fraction;
  return light != nullptr;
}

bool change_ambient(Scene& scene, Camera&, double fraction, Random&) {
  scene.ambient *= 1 + fraction;
  return scene.ambient != Rgbd(0);
}

bool change_background(Scene& scene, Camera&, double fraction, Random&) {
  scene.background *= 1 + fraction;
  return scene.background != Rgbd(0);
}

template <class Geometry>
Geometry* any_shape(Scene& scene, Random& random) {
  Shape* shape = any_of(scene.shapes, random,
                        [](const Shape& s) { return std::holds_alternative<Geometry>(s.geometry); });
  return shape == nullptr ? nullptr : &std::get<Geometry>(shape->geometry);
}

bool change_radius(Scene& scene, Camera&, double fraction, Random& random) {
  auto* sphere = any_shape<Sphere>(scene, random);
  if (sphere != nullptr) sphere->radius *= 1 + fraction;
  return sphere != nullptr;
}

bool move_center(Scene& scene, Camera&, double fraction, Random& random) {
  auto* sphere = any_shape<Sphere>(scene, random);
  if (sphere != nullptr) sphere->center += fraction * sphere->radius * direction(random);
  return sphere != nullptr;
}

bool move_corner(Scene& scene, Camera&, double fraction, Random& random) {
  auto* box = any_shape<Box>(scene, random);
  if (box == nullptr) return false;
  const Vec3d edges = box->max - box->min;
  Vec3d& corner = random() % 2 == 0 ? box->min : box->max;
  corner += fraction * edges;
  return true;
}

bool change_fov(Scene&, Camera& camera, double fraction, Random&) {
  camera.fov_x_degrees *= 1 + fraction;
  return true;
}

/// Against the distance to the nearest light, for want of another length of the scene.
bool move_eye(Scene& scene, Camera& camera, double fraction, Random& random) {
  if (scene.lights.empty()) return false;
  camera.eye += fraction * glm::length(scene.lights.front().position - camera.eye) * direction(random);
  return true;
}

bool turn_camera(Scene&, Camera& camera, double fraction, Random& random) {
  camera.direction += fraction * glm::length(camera.direction) * direction(random);
  return true;
}

template <class Step, class Change>
bool change_step(Scene& scene, Random& random, const Change& change) {
  const auto has_step = [](const Shape& s) {
    return std::any_of(s.transform.begin(), s.transform.end(),
                       [](const TransformStep& t) { return std::holds_alternative<Step>(t); });
  };
  Shape* shape = any_of(scene.shapes, random, has_step);
  if (shape == nullptr) return false;
  for (TransformStep& step : shape->transform) {
    if (auto* found = std::get_if<Step>(&step)) {
      change(*found);
      return true;
    }
  }
  return false;
}

bool change_translation(Scene& scene, Camera&, double fraction, Random& random) {
  return change_step<Translate>(scene, random, [&](Translate& t) { t.by *= 1 + fraction; });
}

bool change_rotation(Scene& scene, Camera&, double fraction, Random& random) {
  return change_step<Rotate>(scene, random, [&](Rotate& r) { r.degrees *= 1 + fraction; });
}

bool change_scale(Scene& scene, Camera&, double fraction, Random& random) {
  return change_step<Scale>(scene, random, [&](Scale& s) { s.by *= 1 + fraction; });
}

}  // namespace

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> all{{"ka", &change_colour<&Material::ka>},
                                          {"kd", &change_colour<&Material::kd>},
                                          {"ks", &change_colour<&Material::ks>},
                                          {"m", &change_exponent},
                                          {"mirror", &change_colour<&Material::mirror>},
                                          {"transmit", &change_colour<&Material::transmit>},
                                          {"eta", &change_eta},
                                          {"light position", &move_light},
                                          {"brightness", &change_brightness},
                                          {"light colour", &change_light_colour},
                                          {"ambient", &change_ambient},
                                          {"background", &change_background},
                                          {"radius", &change_radius},
                                          {"centre", &move_center},
                                          {"box corner", &move_corner},
                                          {"field of view", &change_fov},
                                          {"eye", &move_eye},
                                          {"camera direction", &turn_camera},
                                          {"translation", &change_translation},
                                          {"rotation", &change_rotation},
                                          {"scale", &change_scale}};
  return all;
}

}  // namespace plumb::gate_power
