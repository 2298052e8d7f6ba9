// Slides "Lambert", "Ambient", "Phong" and "Vollstaendiges Modell": one light on one point.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "references/faults/areas.hpp"

namespace plumb::faults {
namespace {

bool always_counts(double) { return true; }

template <auto intensity>
void take_intensity(Subject& s) {
  s.formulas.reflected_intensity = intensity;
}

Rgbd specular_without_colour(const Rgbd& ip, const Rgbd& delta, const Rgbd& kd, double diffuse,
                             const Rgbd& ks, double specular) {
  return delta * (ip * kd * diffuse + ks * specular);
}

Rgbd specular_without_ks(const Rgbd& ip, const Rgbd& delta, const Rgbd& kd, double diffuse, const Rgbd&,
                         double specular) {
  return ip * delta * (kd * diffuse + specular);
}

Rgbd specular_twice(const Rgbd& ip, const Rgbd& delta, const Rgbd& kd, double diffuse, const Rgbd& ks,
                    double specular) {
  return ip * delta * (kd * diffuse + 2.0 * ks * specular);
}

Rgbd diffuse_squared(const Rgbd& ip, const Rgbd& delta, const Rgbd& kd, double diffuse, const Rgbd& ks,
                     double specular) {
  return ip * delta * (ip * kd * (diffuse * diffuse) + ks * specular);
}

std::vector<Fault> of_lambert() {
  return {
      {"negative-diffuse", 9, "Lambert", "A light behind the surface counts with its negative n.l.",
       "Ip kd (n.l)", "Ip kd (n.l) when n.l > 0, else 0", "6 of 42", "unlit-only-ambient.sdf",
       [](Subject& s) {
         s.formulas.light_counts = &always_counts;
         s.formulas.reflected_light = [](const Vec3d& n, const Vec3d& l) {
           return glm::dot(n, l) > 0 ? formulas::reflected_light(n, l) : Vec3d(0);
         };
       },
       nullptr},
      {"absolute-diffuse", 9, "Lambert", "A light behind the surface counts as if it were in front.",
       "Ip kd |n.l|", "Ip kd (n.l) when n.l > 0, else 0", "1 of 42", "unlit-only-ambient.sdf",
       [](Subject& s) {
         s.formulas.diffuse_factor = [](const Vec3d& n, const Vec3d& l) { return std::abs(glm::dot(n, l)); };
       },
       nullptr},
      {"light-vector-not-normalised", 10, "Lambert", "l is not normalised, so light grows with distance.",
       "l = light - p", "l = (light - p) / |light - p|", "4 of 42", "lambert-light-distance.sdf",
       [](Subject& s) {
         s.formulas.toward_light = [](const Vec3d& point, const Vec3d& light) {
           return formulas::Toward<double>{light - point, 1};
         };
       },
       nullptr},
      {"diffuse-squared", 16, "Lambert", "n.l and the light's colour are multiplied in twice.",
       "Ip^2 kd (n.l)^2", "Ip kd (n.l)", "1 of 42", "lambert.sdf", &take_intensity<&diffuse_squared>,
       nullptr},
  };
}

std::vector<Fault> of_the_highlight() {
  return {
      {"specular-not-clamped", 11, "Phong", "A negative r.v is raised to the power m as it is.", "(r.v)^m",
       "(r.v)^m when r.v > 0, else 0", "10 of 42", "phong-odd-exponent.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d& r, const Vec3d& v, const Vec3d&, double m) {
           return std::pow(glm::dot(r, v), m);
         };
       },
       nullptr},
      {"specular-absolute", 11, "Phong", "A highlight also appears on the opposite side.", "|r.v|^m",
       "(r.v)^m when r.v > 0, else 0", "5 of 42", "phong-even-exponent.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d& r, const Vec3d& v, const Vec3d&, double m) {
           return std::pow(std::abs(glm::dot(r, v)), m);
         };
       },
       nullptr},
      {"specular-not-gated", 12, "Phong", "The highlight is added where the light is behind the surface.",
       "ks (r.v)^m for every n.l", "ks (r.v)^m when n.l > 0, else 0", "24 of 42", "phong-light-below.sdf",
       [](Subject& s) {
         s.formulas.light_counts = &always_counts;
         s.formulas.diffuse_factor = [](const Vec3d& n, const Vec3d& l) {
           return std::max(0.0, glm::dot(n, l));
         };
       },
       nullptr},
      {"viewer-is-the-eye", 13, "Phong", "v points to the eye, which is wrong after a reflection.",
       "v = (eye - p) / |eye - p|", "v = -d of the ray that sees p", "8 of 42", "mirror-highlight.sdf",
       [](Subject& s) {
         s.formulas.toward_viewer = [](const formulas::Sight<double>& sight) {
           return glm::normalize(sight.eye - sight.point);
         };
       },
       nullptr},
      {"specular-toward-light", 13, "Phong", "r is multiplied by l instead of by v.", "(r.l)^m", "(r.v)^m",
       "1 of 42", "phong.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d& r, const Vec3d&, const Vec3d& l, double m) {
           const double cosine = glm::dot(r, l);
           return cosine > 0 ? std::pow(cosine, m) : 0;
         };
       },
       nullptr},
      {"specular-half-vector", 44, "Phong", "The half vector of Blinn takes the place of r.",
       "(n.h)^m, h = (l + v) / |l + v|", "(r.v)^m", "1 of 26", "phong.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d& r, const Vec3d& v, const Vec3d& l, double m) {
           const Vec3d n = glm::normalize(r + l), h = glm::normalize(l + v);
           return formulas::specular_factor(n, h, l, m);
         };
       },
       nullptr},
      {"exponent-fixed", 13, "Phong", "The exponent is a constant, whatever the material says.", "(r.v)^20",
       "(r.v)^m", "1 of 42", "phong.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d& r, const Vec3d& v, const Vec3d& l, double) {
           return formulas::specular_factor(r, v, l, 20.0);
         };
       },
       nullptr},
      {"reflected-light-flipped", 14, "Phong", "r points away from where the light is mirrored to.",
       "r = l - 2 (n.l) n", "r = 2 (n.l) n - l", "3 of 42", "phong.sdf",
       [](Subject& s) {
         s.formulas.reflected_light = [](const Vec3d& n, const Vec3d& l) {
           return -formulas::reflected_light(n, l);
         };
       },
       nullptr},
      {"specular-without-light-colour", 15, "Phong", "The highlight does not take the light's colour.",
       "ks (r.v)^m", "Ip ks (r.v)^m", "among 3 of 42", "mirrored-composite.sdf",
       &take_intensity<&specular_without_colour>, nullptr},
      {"specular-without-ks", 15, "Phong", "The highlight does not take the material's ks.", "Ip (r.v)^m",
       "Ip ks (r.v)^m", "among 3 of 42", "phong.sdf", &take_intensity<&specular_without_ks>, nullptr},
      {"specular-twice", 15, "Phong", "The highlight is added twice.", "2 Ip ks (r.v)^m", "Ip ks (r.v)^m",
       "1 of 42", "phong.sdf", &take_intensity<&specular_twice>, nullptr},
      {"specular-normalisation", 15, "Phong", "The highlight has the factor of an energy-conserving model.",
       "(m + 2) / (2 pi) (r.v)^m", "(r.v)^m", "4 of 42", "phong.sdf",
       [](Subject& s) {
         s.formulas.specular_factor = [](const Vec3d& r, const Vec3d& v, const Vec3d& l, double m) {
           return (m + 2) / (2 * std::numbers::pi) * formulas::specular_factor(r, v, l, m);
         };
       },
       nullptr},
  };
}

}  // namespace

std::vector<Fault> of_the_lighting() {
  std::vector<Fault> all = of_lambert();
  for (const Fault& fault : of_the_highlight()) all.push_back(fault);
  return all;
}

}  // namespace plumb::faults
