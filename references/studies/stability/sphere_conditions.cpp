#include "references/studies/stability/conditions.hpp"
#include "references/studies/stability/embree.hpp"
#include "references/studies/stability/spheres.hpp"
#include "tracer/methods/sphere.hpp"
#include "tracer/methods/start.hpp"

namespace plumb::studies::stability {
namespace {

constexpr const char* cancels = "b^2 - 4ac cancels: squares of the distance hide the radius";
constexpr const char* by_distance = "take the discriminant from the centre's distance to the line";

std::vector<Method> spheres(SphereAt setting) {
  return {method(lecture,
                 [=]<class R>(Is<R>) { return sphere_trial<R>(&formulas::intersect_sphere<R>, setting); }),
          method({"sphere-naive", "the lecture's slide", cancels, by_distance},
                 [=]<class R>(Is<R>) { return sphere_trial<R>(&methods::sphere_naive<R>, setting); }),
          method({"sphere-kahan", "Kahan 2004", "the coefficients b and c are rounded before they cancel",
                  by_distance},
                 [=]<class R>(Is<R>) { return sphere_trial<R>(&methods::sphere_kahan<R>, setting); }),
          method({"sphere-haines", "Haines et al. 2019", lecture.cause, lecture.remedy},
                 [=]<class R>(Is<R>) { return sphere_trial<R>(&methods::sphere_haines<R>, setting); }),
          method({"sphere-geometric", "Haines 1989", "squared distances cancel", by_distance},
                 [=]<class R>(Is<R>) { return sphere_trial<R>(&methods::sphere_geometric<R>, setting); })};
}

/// `way` gives the start in a real type.
template <class Way>
Method start(const Words& words, SphereAt setting, Way way) {
  return method(words, [=]<class R>(Is<R> real) { return start_trial<R>(way(real), setting); });
}

template <class R>
Start<R> by_nothing(Is<R>) {
  return {&formulas::secondary_origin<R>, &methods::ahead_of_zero<R>, false};
}

void add_starts(std::vector<Method>& to, SphereAt setting) {
  constexpr const char* exclude = "exclude the surface by its id";
  to.push_back(
      start({"start-id", "this project", lecture.cause, lecture.remedy}, setting, []<class R>(Is<R>) {
        return Start<R>{&formulas::secondary_origin<R>, &formulas::is_ahead<R>, true};
      }));
  to.push_back(start({"start-nothing", "no source", "the point lies beside the surface by rounding", exclude},
                     setting, []<class R>(Is<R> real) { return by_nothing(real); }));
  to.push_back(start({"start-epsilon", "common use", "1e-4 fits scenes of one size alone", exclude}, setting,
                     []<class R>(Is<R>) {
                       return Start<R>{&methods::epsilon_ahead<R>, &methods::ahead_of_zero<R>, false};
                     }));
  to.push_back(start({"start-normal-offset", "common use", "1e-4 fits scenes of one size alone", exclude},
                     setting, []<class R>(Is<R>) {
                       return Start<R>{&methods::normal_offset<R>, &methods::ahead_of_zero<R>, false};
                     }));
  to.push_back(start({"start-waechter-binder", "Waechter, Binder 2019",
                      "the point is off by more than 256 ulp: t is long against the coordinates", exclude},
                     setting, []<class R>(Is<R>) {
                       return Start<R>{&methods::waechter_binder<R>, &methods::ahead_of_zero<R>, false};
                     }));
  to.push_back(
      start({"start-error-bound", "Pharr et al. 2023",
             "the bound is that of the point, not of the centre and the radius it was made from", exclude},
            setting, []<class R>(Is<R>) {
              return Start<R>{&methods::error_bound<R>, &methods::ahead_of_zero<R>, false, true};
            }));
}

ConditionEntry sphere_condition(const char* name, const char* unit, double last, SphereAt setting) {
  ConditionEntry entry{name, unit, last, false, 400, spheres(setting)};
  add_starts(entry.methods, setting);
  entry.methods.push_back(
      by_embree("embree", "Embree 3, sphere points", sphere_trial<float>(&embree_sphere, setting)));
  entry.methods.push_back(by_embree("embree-secondary", "Embree 3, tnear 0",
                                    start_trial<float>(by_nothing(Is<float>()), setting, &embree_sphere)));
  return entry;
}

}  // namespace

std::vector<ConditionEntry> conditions_of_spheres() {
  return {sphere_condition("distance", "distance / radius", 1e12, &far_sphere),
          sphere_condition("small-radius", "scene / radius", 1e12, &small_sphere),
          sphere_condition("scale-up", "scene scale", 1e12, &scaled_sphere),
          sphere_condition("scale-down", "1 / scene scale", 1e12, &shrunk_sphere),
          sphere_condition("offset", "distance from the origin / radius", 1e12, &offset_sphere),
          sphere_condition("grazing", "1 / angle to the surface", 1e9, &grazed_sphere)};
}

}  // namespace plumb::studies::stability
