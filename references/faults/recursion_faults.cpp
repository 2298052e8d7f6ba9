// Slide "Spiegelung, Brechung".
#include <algorithm>
#include <cmath>
#include <optional>

#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

using Bent = std::optional<Vec3d>;

Rgbd mixed(const Rgbd& local, const Rgbd& kr, const Rgbd& mirrored, const Rgbd& kt, const Rgbd& refracted) {
  return (1.0 - kr) * local + kr * mirrored + kt * refracted;
}

Rgbd by_constant(const Rgbd& local, const Rgbd&, const Rgbd& mirrored, const Rgbd& kt,
                 const Rgbd& refracted) {
  return local + 0.5 * mirrored + kt * refracted;
}

Rgbd unweighted(const Rgbd& local, const Rgbd&, const Rgbd& mirrored, const Rgbd& kt, const Rgbd& refracted) {
  return local + mirrored + kt * refracted;
}

Bent clamped(const Vec3d& d, const Vec3d& n, double ratio) {
  const double cos_i = -glm::dot(d, n);
  const double cos_t_squared = std::max(0.0, 1 - ratio * ratio * (1 - cos_i * cos_i));
  return glm::normalize(ratio * d + (ratio * cos_i - std::sqrt(cos_t_squared)) * n);
}

Rgbd tone_mapped(const Rgbd& colour) { return colour / (colour + 1.0); }

Rgbd gamma_encoded(const Rgbd& colour) { return glm::pow(glm::max(colour, Rgbd(0)), Rgbd(1 / 2.2)); }

template <auto encode>
void encode_in_recursion(Subject& s) {
  s.formulas.combined_colour = [](const Rgbd& local, const Rgbd& kr, const Rgbd& mirrored, const Rgbd& kt,
                                  const Rgbd& refracted) {
    return local + kr * encode(mirrored) + kt * encode(refracted);
  };
  s.formulas.colour_at_total_reflection = [](const Rgbd& local, const Rgbd& reflected) {
    return local + encode(reflected);
  };
}

std::vector<Fault> of_the_mirror() {
  return {
      {"mirror-direction-flipped", 14, "Spiegelung", "The mirrored ray goes back into the surface.",
       "r = d + 2 (d.n) n", "r = d - 2 (d.n) n", "among 3 of 42", "mirror.sdf",
       [](Subject& s) {
         s.formulas.mirror_direction = [](const Vec3d& d, const Vec3d& n) {
           return glm::normalize(d + 2 * glm::dot(d, n) * n);
         };
       },
       nullptr},
      {"mirror-weight-ks", 34, "Spiegelung", "The mirrored colour is weighted with ks.", "local + ks R",
       "local + kr R", "not counted", "mirror-highlight.sdf",
       [](Subject& s) {
         for (Material& material : s.scene.materials) {
           if (material.mirrors()) material.mirror = material.ks;
         }
       },
       nullptr},
      {"every-object-mirrors", 42, "Spiegelung", "Everything mirrors, with ks as its weight.",
       "local + ks R, for every material", "local + kr R", "10 of 26", "phong.sdf",
       [](Subject& s) {
         for (Material& material : s.scene.materials) material.mirror = material.ks;
       },
       nullptr},
      {"mirror-weight-mixed", 34, "Spiegelung", "The local colour is taken down where the mirror is put in.",
       "(1 - kr) local + kr R", "local + kr R", "not counted", "mirror.sdf",
       [](Subject& s) { s.formulas.combined_colour = &mixed; }, nullptr},
      {"mirror-weight-constant", 34, "Spiegelung", "The weight is a constant of the program.",
       "local + 0.5 R", "local + kr R", "not counted", "mirror.sdf",
       [](Subject& s) { s.formulas.combined_colour = &by_constant; }, nullptr},
      {"mirror-unweighted", 34, "Spiegelung", "Every mirror is a perfect one.", "local + R", "local + kr R",
       "not counted", "mirror.sdf", [](Subject& s) { s.formulas.combined_colour = &unweighted; }, nullptr},
      {"recursion-too-deep", 34, "Spiegelung, Brechung",
       "The depth is not counted, so the recursion ends late; here after twice the depth.",
       "trace(depth), trace(depth), ...", "trace(depth + 1), black when depth >= D", "not counted",
       "recursion-depth.sdf",
       [](Subject& s) { s.job.options.depth = std::min(2 * s.job.options.depth, max_depth); }, nullptr},
      {"depth-counter-shared", 34, "Spiegelung, Brechung",
       "All rays of a pixel share one counter, which is never taken back.", "++depth for every ray",
       "depth + 1 handed to each child", "not counted", "combined-everything.sdf",
       [](Subject& s) {
         s.formulas.is_too_deep = [](int, int limit, int rays_before) { return rays_before >= limit; };
       },
       nullptr},
  };
}

std::vector<Fault> of_the_glass() {
  return {
      {"eta-not-inverted-on-leaving", 35, "Brechung", "A ray that leaves bends as if it entered.",
       "ratio = 1 / eta, always", "ratio = eta1 / eta2: 1 / eta inwards, eta outwards", "not counted",
       "refraction.sdf",
       [](Subject& s) {
         s.formulas.refracted_direction = [](const Vec3d& d, const Vec3d& n, double ratio) {
           return formulas::refracted_direction(d, n, std::min(ratio, 1 / ratio));
         };
       },
       nullptr},
      {"eta-inverted", 35, "Brechung", "The ratio of the refractive indices is upside down.",
       "ratio = eta2 / eta1", "ratio = eta1 / eta2", "not counted", "refraction.sdf",
       [](Subject& s) {
         s.formulas.refracted_direction = [](const Vec3d& d, const Vec3d& n, double ratio) {
           return formulas::refracted_direction(d, n, 1 / ratio);
         };
       },
       nullptr},
      {"total-reflection-clamped", 35, "Brechung", "The negative root is clamped, and the ray goes out.",
       "sqrt(max(0, cos_t^2))", "reflected when cos_t^2 < 0", "not counted", "total-reflection.sdf",
       [](Subject& s) { s.formulas.refracted_direction = &clamped; }, nullptr},
      {"total-reflection-black", 35, "Brechung", "Where the ray cannot leave, nothing is seen.", "local",
       "local + R", "not counted", "total-reflection.sdf",
       [](Subject& s) {
         s.formulas.colour_at_total_reflection = [](const Rgbd& local, const Rgbd&) { return local; };
       },
       nullptr},
      {"eta-is-opacity", 35, "Brechung", "The weight of the refracted ray is taken for its index.",
       "eta = kt", "eta = the material's eta", "not counted", "refraction.sdf",
       [](Subject& s) {
         for (Material& material : s.scene.materials) {
           if (material.transmits()) material.eta = std::max(0.01, material.transmit.x);
         }
       },
       nullptr},
      {"refraction-not-bent", 35, "Brechung", "The ray goes straight on.", "t = d",
       "sin t = eta1 / eta2 sin i", "not counted", "refraction.sdf",
       [](Subject& s) {
         s.formulas.refracted_direction = [](const Vec3d& d, const Vec3d&, double) { return Bent(d); };
       },
       nullptr},
      {"tone-map-in-recursion", 36, "Decision",
       "Colours are tone-mapped at every level, not once at the end.", "local + kr R / (R + 1)",
       "local + kr R, then c / (c + 1)", "7 of 42", "refraction.sdf", &encode_in_recursion<&tone_mapped>,
       nullptr},
      {"gamma-in-recursion", 36, "Decision", "Colours are gamma-encoded at every level.",
       "local + kr R^(1/2.2)", "local + kr R", "1 of 42", "refraction.sdf",
       &encode_in_recursion<&gamma_encoded>, nullptr},
  };
}

}  // namespace

std::vector<Fault> of_the_recursion() {
  std::vector<Fault> all = of_the_mirror();
  for (const Fault& fault : of_the_glass()) all.push_back(fault);
  return all;
}

}  // namespace plumb::faults
