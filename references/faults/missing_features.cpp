// What a tracer leaves out: the number 38 of the catalogue.
#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

template <auto what>
void take_out(Subject& s) {
  for (Material& material : s.scene.materials) material.*what = Rgbd(0);
}

Rgbd without_diffuse(const Rgbd& ip, const Rgbd& delta, const Rgbd&, double, const Rgbd& ks,
                     double specular) {
  return ip * delta * ks * specular;
}

std::vector<Fault> of_the_missing_terms() {
  return {
      {"ambient-missing", 38, "Ambient", "There is no ambient term.", "I = sum ...", "I = Ia ka + sum ...",
       "not counted", "ambient.sdf", [](Subject& s) { s.scene.ambient = Rgbd(0); }, nullptr},
      {"diffuse-missing", 38, "Lambert", "There is no diffuse term.", "Ip ks (r.v)^m",
       "Ip (kd (n.l) + ks (r.v)^m)", "not counted", "lambert.sdf",
       [](Subject& s) { s.formulas.reflected_intensity = &without_diffuse; }, nullptr},
      {"specular-missing", 38, "Phong", "There are no highlights.", "Ip kd (n.l)",
       "Ip (kd (n.l) + ks (r.v)^m)", "not counted", "phong.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d&, const Vec3d&, const Vec3d&, double) { return 0.0; };
       },
       nullptr},
  };
}

}  // namespace

std::vector<Fault> of_what_is_missing() {
  std::vector<Fault> all = of_the_missing_terms();
  const std::vector<Fault> others{
      {"shadows-missing", 38, "Schatten", "Nothing casts a shadow.", "delta = 1",
       "delta = 0 if any object lies between", "not counted", "shadow.sdf",
       [](Subject& s) { s.job.options.shadows = false; }, nullptr},
      {"mirror-missing", 38, "Spiegelung", "Nothing mirrors.", "local", "local + kr R", "8 of 17",
       "mirror.sdf", &take_out<&Material::mirror>, nullptr},
      {"glass-opaque", 38, "Brechung", "Nothing is seen through glass.", "local", "local + kt T",
       "not counted", "refraction.sdf", &take_out<&Material::transmit>, nullptr},
      {"transforms-missing", 38, "Transformationen", "Transforms move no shape: missing, or without effect.",
       "M = I", "M = T R S", "4 of 17", "composed-trs.sdf",
       [](Subject& s) {
         for (Shape& shape : s.scene.shapes) shape.transform.clear();
       },
       nullptr},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace plumb::faults
