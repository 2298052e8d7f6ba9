#include "references/stability/catalogue.hpp"

#include <type_traits>

#include "references/stability/boxes.hpp"
#include "references/stability/chains.hpp"
#include "references/stability/spheres.hpp"
#include "tracer/formulas/secondary.hpp"
#include "tracer/formulas/sphere.hpp"
#include "tracer/methods/box.hpp"
#include "tracer/methods/sphere.hpp"
#include "tracer/methods/start.hpp"

namespace plumb::references::stability {
namespace {

template <class Real>
using Is = std::type_identity<Real>;

struct Words {
  const char *id, *source, *cause, *remedy;
};

/// `make` gives the experiment in a real type.
template <class Make>
Method method(const Words& words, Make make) {
  return {words.id,
          words.source,
          words.cause,
          words.remedy,
          {make(Is<float>()), make(Is<double>()), make(Is<long double>())}};
}

constexpr Words lecture{"lecture", "the lecture", "coordinates carry few bits across the object",
                        "a wider real type, or coordinates near the object"};
constexpr const char* cancels = "b^2 - 4ac cancels: squares of the distance hide the radius";
constexpr const char* by_distance = "take the discriminant from the centre's distance to the line";

template <auto setting>
std::vector<Method> spheres() {
  return {method(lecture,
                 []<class R>(Is<R>) { return &sphere_trial<R, &formulas::intersect_sphere<R>, setting>; }),
          method({"sphere-naive", "the lecture's slide", cancels, by_distance},
                 []<class R>(Is<R>) { return &sphere_trial<R, &methods::sphere_naive<R>, setting>; }),
          method({"sphere-kahan", "Kahan 2004", "the coefficients b and c are rounded before they cancel",
                  by_distance},
                 []<class R>(Is<R>) { return &sphere_trial<R, &methods::sphere_kahan<R>, setting>; }),
          method({"sphere-haines", "Haines et al. 2019", lecture.cause, lecture.remedy},
                 []<class R>(Is<R>) { return &sphere_trial<R, &methods::sphere_haines<R>, setting>; }),
          method({"sphere-geometric", "Haines 1989", "squared distances cancel", by_distance},
                 []<class R>(Is<R>) { return &sphere_trial<R, &methods::sphere_geometric<R>, setting>; })};
}

struct ByNothing {
  template <class R>
  constexpr Start<R> of() const {
    return {&formulas::secondary_origin<R>, &methods::ahead_of_zero<R>, false};
  }
};
struct ByEpsilon {
  template <class R>
  constexpr Start<R> of() const {
    return {&methods::epsilon_ahead<R>, &methods::ahead_of_zero<R>, false};
  }
};
struct ByNormal {
  template <class R>
  constexpr Start<R> of() const {
    return {&methods::normal_offset<R>, &methods::ahead_of_zero<R>, false};
  }
};
struct ByUlps {
  template <class R>
  constexpr Start<R> of() const {
    return {&methods::waechter_binder<R>, &methods::ahead_of_zero<R>, false};
  }
};
struct ByBound {
  template <class R>
  constexpr Start<R> of() const {
    return {&methods::error_bound<R>, &methods::ahead_of_zero<R>, false, true};
  }
};
struct ById {
  template <class R>
  constexpr Start<R> of() const {
    return {&formulas::secondary_origin<R>, &formulas::is_ahead<R>, true};
  }
};

template <auto setting, class Way>
Method start(const Words& words, Way) {
  return method(words, []<class R>(Is<R>) { return &start_trial<R, Way{}, setting>; });
}

template <auto setting>
void add_starts(std::vector<Method>& to) {
  constexpr const char* exclude = "exclude the surface by its id";
  to.push_back(start<setting>({"start-id", "this project", lecture.cause, lecture.remedy}, ById()));
  to.push_back(start<setting>(
      {"start-nothing", "no source", "the point lies beside the surface by rounding", exclude}, ByNothing()));
  to.push_back(start<setting>({"start-epsilon", "common use", "1e-4 fits scenes of one size alone", exclude},
                              ByEpsilon()));
  to.push_back(start<setting>(
      {"start-normal-offset", "common use", "1e-4 fits scenes of one size alone", exclude}, ByNormal()));
  to.push_back(
      start<setting>({"start-waechter-binder", "Waechter, Binder 2019",
                      "the point is off by more than 256 ulp: t is long against the coordinates", exclude},
                     ByUlps()));
  to.push_back(start<setting>(
      {"start-error-bound", "Pharr et al. 2023",
       "the bound is that of the point, not of the centre and the radius it was made from", exclude},
      ByBound()));
}

template <auto setting>
ConditionEntry sphere_condition(const char* name, const char* unit, double last) {
  ConditionEntry entry{name, unit, last, false, 400, spheres<setting>()};
  add_starts<setting>(entry.methods);
  return entry;
}

template <class Setting>
std::vector<Method> boxes(Setting) {
  constexpr const char* edge = "points on an edge are rounded to outside";
  constexpr const char* slabs = "compare distances along the ray, not points";
  return {
      method(
          {"lecture", "the lecture", lecture.cause, lecture.remedy},
          []<class R>(Is<R>) { return &box_trial<R, &formulas::intersect_box<R>, Setting::template of<R>>; }),
      method(
          {"box-six-planes", "the lecture's slide", edge, slabs},
          []<class R>(Is<R>) { return &box_trial<R, &methods::box_six_planes<R>, Setting::template of<R>>; }),
      method({"box-front-faces", "Woo 1990", edge, slabs},
             []<class R>(Is<R>) {
               return &box_trial<R, &methods::box_front_faces<R>, Setting::template of<R>>;
             }),
      method(
          {"box-kay-kajiya", "Kay, Kajiya 1986", lecture.cause, "widen the far side by 2 ulp"},
          []<class R>(Is<R>) { return &box_trial<R, &methods::box_kay_kajiya<R>, Setting::template of<R>>; }),
      method(
          {"box-williams", "Williams et al. 2005", "0 times infinity in the plane of a face",
           "a case for direction 0"},
          []<class R>(Is<R>) { return &box_trial<R, &methods::box_williams<R>, Setting::template of<R>>; }),
      method({"box-ize", "Ize 2013", lecture.cause, lecture.remedy},
             []<class R>(Is<R>) { return &box_trial<R, &methods::box_ize<R>, Setting::template of<R>>; })};
}
struct Thin {
  template <class R>
  static BoxCase<R> of(double v, Random& random) {
    return thin_box<R>(v, random);
  }
};
struct Edge {
  template <class R>
  static BoxCase<R> of(double v, Random& random) {
    return box_edge<R>(v, random);
  }
};
struct Parallel {
  template <class R>
  static BoxCase<R> of(double v, Random& random) {
    return near_parallel<R>(v, random);
  }
};

template <auto steps>
std::vector<Method> transforms() {
  return {method({"lecture", "the lecture", "rounding of every matrix adds up", "a wider real type"},
                 []<class R>(Is<R>) { return &placed_trial<R, &transform_of<R>, steps>; }),
          method({"inverse-of-product", "common use", "the inverse loses the condition number once more",
                  "multiply the inverses of the parts"},
                 []<class R>(Is<R>) { return &placed_trial<R, &methods::inverse_of_product<R>, steps>; }),
          method({"direction-normalised", "common use", "rounding of the length, and of the division back",
                  "leave the direction as it is"},
                 []<class R>(Is<R>) { return &placed_trial<R, &transform_of<R>, steps, true>; })};
}

}  // namespace

std::vector<ConditionEntry> catalogue() {
  return {sphere_condition<&far_sphere>("distance", "distance / radius", 1e12),
          sphere_condition<&small_sphere>("small-radius", "scene / radius", 1e12),
          sphere_condition<&scaled_sphere>("scale-up", "scene scale", 1e12),
          sphere_condition<&shrunk_sphere>("scale-down", "1 / scene scale", 1e12),
          sphere_condition<&offset_sphere>("offset", "distance from the origin / radius", 1e12),
          sphere_condition<&grazed_sphere>("grazing", "1 / angle to the surface", 1e9),
          {"box-aspect", "width / thickness", 1e12, false, 400, boxes(Thin())},
          {"box-edge", "1 / distance of the aim from an edge", 1e18, false, 400, boxes(Edge())},
          {"box-parallel", "1 / tilt", 1e18, false, 400, boxes(Parallel())},
          {"flattening", "width / thickness", 1e12, false, 200, transforms<&flattened>()},
          {"condition-number", "condition number", 1e12, false, 200, transforms<&pressed>()},
          {"nesting", "transforms", 1e4, true, 20, transforms<&nested>()},
          {"index-near-1",
           "1 / (index - 1)",
           1e18,
           false,
           400,
           {method({"lecture", "Heckbert 1989", "1 + 1/v is rounded", "a wider real type"},
                   []<class R>(Is<R>) { return &index_near_one<R>; })}},
          {"critical-angle",
           "1 / angle below the critical",
           1e18,
           false,
           400,
           {method({"lecture", "Heckbert 1989", "1 - ratio^2 sin^2 cancels", "a wider real type"},
                   []<class R>(Is<R>) { return &near_critical<R>; })}},
          {"recursion",
           "depth",
           256,
           true,
           100,
           {method({"lecture", "the lecture", "errors add up from mirror to mirror", "a wider real type"},
                   []<class R>(Is<R>) { return &reflections<R, true>; }),
            method({"normal-as-it-is", "a common mistake",
                    "a normal's wrong length grows from mirror to mirror", "normalise every normal"},
                   []<class R>(Is<R>) { return &reflections<R, false>; })}}};
}

}  // namespace plumb::references::stability
