// Slides "Ambient" and "Vollstaendiges Modell": all lights together.
#include <utility>

#include "references/faults/areas.hpp"
#include "tracer/scene/hierarchy.hpp"

namespace plumb::faults {
namespace {

void swap_ka_and_kd(Subject& s) {
  for (Material& material : s.scene.materials) std::swap(material.ka, material.kd);
}

void keep_the_last_light(Subject& s) {
  auto& lights = s.scene.lights;
  if (lights.size() > 1) lights.erase(lights.begin(), lights.end() - 1);
}

/// Makes a copy of each light for each object, which alone can hide it.
void light_once_per_object(Subject& s) {
  std::uint64_t objects = 0;
  const std::vector<std::uint64_t> counts = count_instances(s.scene);
  for (const ShapeId root : s.scene.roots()) objects += counts[root];
  constexpr std::uint64_t most_copies = 10'000;  // because a scene of millions of objects would not end
  if (objects == 0 || objects * s.scene.lights.size() > most_copies) return;
  std::vector<Light> copies;
  for (const Light& light : s.scene.lights) copies.insert(copies.end(), objects, light);
  s.scene.lights = std::move(copies);
  s.formulas.may_block = [](const formulas::Blocking& objects_and_light) {
    return objects_and_light.candidate == objects_and_light.light % (objects_and_light.last + 1);
  };
}

void average_lights(Subject& s) {
  for (Light& light : s.scene.lights) light.brightness /= static_cast<double>(s.scene.lights.size());
}

}  // namespace

std::vector<Fault> of_the_lights() {
  return {
      {"ambient-per-light", 17, "Ambient", "The ambient term is added once for each light.",
       "I = sum (Ia ka + ...)", "I = Ia ka + sum ...", "1 of 42", "several-lights.sdf",
       [](Subject& s) { s.scene.ambient *= static_cast<double>(s.scene.lights.size()); }, nullptr},
      {"ambient-hard-coded", 17, "Ambient", "The ambient light is a constant of the program.", "0.1 ka",
       "Ia ka", "3 of 42", "ambient.sdf", [](Subject& s) { s.scene.ambient = Rgbd(0.1); }, nullptr},
      {"ambient-without-ka", 17, "Ambient",
       "The ambient light is added as it is, whatever the material says.", "Ia", "Ia ka", "among 26",
       "full-model.sdf",
       [](Subject& s) {
         s.formulas.ambient_light = [](const Rgbd& intensity, const Rgbd&) { return intensity; };
       },
       nullptr},
      {"background-as-ambient", 17, "Ambient", "The background's colour is used as the ambient light.",
       "background ka", "Ia ka", "1 of 42", "ambient.sdf",
       [](Subject& s) { s.scene.ambient = s.scene.background; }, nullptr},
      {"ka-kd-swapped", 17, "Ambient", "ka and kd have changed places.", "Ia kd + Ip ka (n.l)",
       "Ia ka + Ip kd (n.l)", "1 of 42", "full-model.sdf", &swap_ka_and_kd, nullptr},
      {"last-light-only", 17, "Vollstaendiges Modell", "Each light replaces what the ones before it gave.",
       "I = Ia ka + term of the last light", "I = Ia ka + sum of all lights' terms", "1 of 42",
       "several-lights.sdf", &keep_the_last_light, nullptr},
      {"light-colour-ignored", 18, "Vollstaendiges Modell", "All light is white.", "Ip = brightness",
       "Ip = brightness colour", "among 3 of 42", "coloured-light.sdf",
       [](Subject& s) {
         for (Light& light : s.scene.lights) light.color = Rgbd(1);
       },
       nullptr},
      {"brightness-ignored", 18, "Vollstaendiges Modell", "A light's brightness is read, but not used.",
       "Ip = colour", "Ip = brightness colour", "among 3 of 42", "several-lights.sdf",
       [](Subject& s) {
         for (Light& light : s.scene.lights) light.brightness = 1;
       },
       nullptr},
      {"lights-averaged", 18, "Vollstaendiges Modell", "The sum of the lights is divided by their number.",
       "1/n sum Ip_i ...", "sum Ip_i ...", "2 of 42", "several-lights.sdf", &average_lights, nullptr},
      {"inverse-square-falloff", 18, "Lambert", "Light fades with the square of its distance.",
       "Ip / distance^2", "Ip", "1 of 42", "lambert-light-distance.sdf",
       [](Subject& s) {
         s.formulas.arriving_light = [](const Rgbd& intensity, double distance) {
           return intensity / (distance * distance);
         };
       },
       nullptr},
      {"light-once-per-object", 39, "Schatten",
       "A light is added once for every object that does not hide it.", "sum over the objects of Ip ...",
       "Ip ... once, when no object hides it", "2 of 17", "combined-still-life.sdf", &light_once_per_object,
       nullptr},
  };
}

}  // namespace plumb::faults
