#include "references/studies/stability/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "references/studies/stability/boxes.hpp"
#include "references/studies/stability/chains.hpp"
#include "references/studies/stability/embree.hpp"
#include "references/studies/stability/rendered.hpp"
#include "references/studies/stability/spheres.hpp"
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

/// What is no number is farther off than any other.
double farther(double a, double b) {
  return std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

/// The same rays at every value, so that bisection sees one condition change.
Probe of_rays(Experiment experiment) {
  return [experiment = std::move(experiment)](double value, int rays) {
    Random random(1);
    Outcome all;
    int asked = 0;
    for (int i = 0; i < rays; ++i) {
      const Trial trial = experiment(value, random);
      if (!trial.counts) continue;
      ++asked;
      all.missed |= trial.missed;
      all.self_shadow |= trial.self_shadow;
      const bool is_wrong = trial.missed || trial.self_shadow || !(trial.relative <= 0.01);
      all.wrong += is_wrong ? 1 : 0;
      if (trial.missed) continue;
      all.ulps = farther(all.ulps, trial.ulps);
      all.relative = farther(all.relative, trial.relative);
    }
    all.counts = asked > 0;
    if (all.counts) all.wrong /= asked;
    return all;
  };
}

/// `make` gives the experiment in a real type.
template <class Make>
Method method(const Words& words, Make make, Measure measures = Measure::t) {
  return {words.id,
          words.source,
          words.cause,
          words.remedy,
          measures,
          {{"float", of_rays(make(Is<float>())), ""},
           {"double", of_rays(make(Is<double>())), ""},
           {"long-double", of_rays(make(Is<long double>())), ""}}};
}

Method by_embree(const char* id, const char* source, Experiment experiment) {
  return {id,
          source,
          "24 bits of a float, and the reciprocals of the hierarchy",
          "doubles, or coordinates near the object",
          Measure::t,
          {{"float", of_rays(std::move(experiment)), embree_version()}}};
}

Method pictures(const Words& words, const char* real, const std::string& renderer, Probe probe) {
  return {words.id,     words.source,    words.cause,
          words.remedy, Measure::pixels, {{real, std::move(probe), renderer}}};
}

constexpr const char* absolute = "its tolerances are absolute: depth 1e-6, nearest hit 1e-4, shadow 1e-3";

/// POV-Ray counts in double.
void add_povray(ConditionEntry& entry) {
  entry.methods.push_back(
      pictures({"povray", "POV-Ray 3.7, the scene's own units", absolute, "export the scene scaled"},
               "double", povray_version(), against_oracle(entry.name, by_povray(false))));
  entry.methods.push_back(pictures({"povray-rescaled", "POV-Ray 3.7, as plumb exports", absolute,
                                    "no single scale fits both sizes: judge the pixels by 113 bits"},
                                   "double", povray_version(), against_oracle(entry.name, by_povray(true))));
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
  entry.methods.push_back(
      by_embree("embree", "Embree 3, sphere points", &sphere_trial<float, &embree_sphere, setting>));
  entry.methods.push_back(by_embree("embree-secondary", "Embree 3, tnear 0",
                                    &start_trial<float, ByNothing{}, setting, &embree_sphere>));
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
             []<class R>(Is<R>) { return &box_trial<R, &methods::box_ize<R>, Setting::template of<R>>; }),
      by_embree("embree", "Embree 3, six quadrilaterals",
                &box_trial<float, &embree_box, Setting::template of<float>>)};
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

std::optional<float> embree_instance(const Placed<float>& placed, const Ray<float>& ray) {
  return embree_placed_sphere(ray, placed.here.matrix);
}

template <auto steps>
std::vector<Method> transforms() {
  return {
      method({"lecture", "the lecture", "rounding of every matrix adds up", "a wider real type"},
             []<class R>(Is<R>) { return &placed_trial<R, &transform_of<R>, steps, &in_object_space<R>>; }),
      method({"inverse-of-product", "common use", "the inverse loses the condition number once more",
              "multiply the inverses of the parts"},
             []<class R>(Is<R>) {
               return &placed_trial<R, &methods::inverse_of_product<R>, steps, &in_object_space<R>>;
             }),
      method(
          {"direction-normalised", "common use", "rounding of the length, and of the division back",
           "leave the direction as it is"},
          []<class R>(Is<R>) { return &placed_trial<R, &transform_of<R>, steps, &with_unit_direction<R>>; }),
      by_embree("embree", "Embree 3, an instance",
                &placed_trial<float, &transform_of<float>, steps, &embree_instance>)};
}

/// Whole pictures by the lecture's formulas, where no single ray shows the condition.
void add_lecture_pictures(ConditionEntry& entry) {
  Method method{lecture.id, lecture.source, lecture.cause, lecture.remedy, Measure::pixels, {}};
  for (const auto& [name, real] :
       {std::pair("float", RealType::float32), std::pair("double", RealType::float64),
        std::pair("long-double", RealType::long_double)})
    method.variants.push_back({name, against_oracle(entry.name, by_textbook(real)), ""});
  entry.methods.push_back(std::move(method));
}

ConditionEntry picture_condition(const char* name, const char* unit, double last) {
  ConditionEntry entry{name, unit, last, false, 0, {}};
  add_lecture_pictures(entry);
  return entry;
}

ConditionEntry block_size() {
  ConditionEntry entry{"block-size", "1 / scene scale", 1e9, false, 0, {}};
  entry.methods.push_back(
      pictures({"povray-blocks", "POV-Ray 3.7, +BS4 +WT1 instead of +WT2",
                "what a ray meets first is remembered from pixel to pixel, and tolerances are absolute",
                "export the scene scaled"},
               "double", povray_version(),
               against_each_other(entry.name, by_povray(false), by_povray_in_other_blocks())));
  return entry;
}

std::vector<ConditionEntry> conditions_of_rays() {
  return {sphere_condition<&far_sphere>("distance", "distance / radius", 1e12),
          sphere_condition<&small_sphere>("small-radius", "scene / radius", 1e12),
          sphere_condition<&scaled_sphere>("scale-up", "scene scale", 1e12),
          sphere_condition<&shrunk_sphere>("scale-down", "1 / scene scale", 1e12),
          sphere_condition<&offset_sphere>("offset", "distance from the origin / radius", 1e12),
          sphere_condition<&grazed_sphere>("grazing", "1 / angle to the surface", 1e9),
          {"box-aspect", "width / thickness", 1e12, false, 3000, boxes(Thin())},
          {"box-edge", "1 / distance of the aim from an edge", 1e18, false, 3000, boxes(Edge())},
          {"box-parallel", "1 / tilt", 1e18, false, 3000, boxes(Parallel())},
          {"flattening", "width / thickness", 1e12, false, 200, transforms<&flattened>()},
          {"condition-number", "condition number", 1e12, false, 200, transforms<&pressed>()},
          {"nesting", "transforms", 1e4, true, 20, transforms<&nested>()},
          {"index-near-1",
           "1 / (index - 1)",
           1e18,
           false,
           400,
           {method(
               {"lecture", "Heckbert 1989", "1 + 1/v is rounded", "a wider real type"},
               []<class R>(Is<R>) { return &index_near_one<R>; }, Measure::direction)}},
          {"critical-angle",
           "1 / angle below the critical",
           1e18,
           false,
           400,
           {method(
               {"lecture", "Heckbert 1989", "1 - ratio^2 sin^2 cancels", "a wider real type"},
               []<class R>(Is<R>) { return &near_critical<R>; }, Measure::direction)}},
          {"recursion",
           "depth",
           256,
           true,
           100,
           {method(
                {"lecture", "the lecture", "errors add up from mirror to mirror", "a wider real type"},
                []<class R>(Is<R>) { return &reflections<R, true>; }, Measure::point),
            method(
                {"normal-as-it-is", "a common mistake", "a normal's wrong length grows from mirror to mirror",
                 "normalise every normal"},
                []<class R>(Is<R>) { return &reflections<R, false>; }, Measure::point)}}};
}

}  // namespace

std::vector<ConditionEntry> catalogue() {
  std::vector<ConditionEntry> all = conditions_of_rays();
  all.push_back(picture_condition("thin-glass", "1 / thickness of a pane", 1e9));
  all.push_back(picture_condition("gap", "1 / gap between glass and floor", 1e9));
  for (ConditionEntry& entry : all) {
    if (world_of(entry.name, 2)) add_povray(entry);
  }
  all.push_back(block_size());
  for (ConditionEntry& entry : all) {
    for (Method& method : entry.methods) explain(entry.name, method);
  }
  return all;
}

}  // namespace plumb::references::stability
