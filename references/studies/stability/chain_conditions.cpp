#include "references/studies/stability/chains.hpp"
#include "references/studies/stability/conditions.hpp"
#include "references/studies/stability/embree.hpp"

namespace plumb::studies::stability {
namespace {

std::optional<float> embree_instance(const Placed<float>& placed, const Ray<float>& ray) {
  return embree_placed_sphere(ray, placed.here.matrix);
}

std::vector<Method> transforms(Places<float>::StepsAt steps) {
  return {
      method({"lecture", "the lecture", "rounding of every matrix adds up", "a wider real type"},
             [=]<class R>(Is<R>) { return placed_trial<R>(&transform_of<R>, steps, &in_object_space<R>); }),
      method({"inverse-of-product", "common use", "the inverse loses the condition number once more",
              "multiply the inverses of the parts"},
             [=]<class R>(Is<R>) {
               return placed_trial<R>(&methods::inverse_of_product<R>, steps, &in_object_space<R>);
             }),
      method(
          {"direction-normalised", "common use", "rounding of the length, and of the division back",
           "leave the direction as it is"},
          [=]<class R>(Is<R>) { return placed_trial<R>(&transform_of<R>, steps, &with_unit_direction<R>); }),
      by_embree("embree", "Embree 3, an instance",
                placed_trial<float>(&transform_of<float>, steps, &embree_instance))};
}

}  // namespace

std::vector<ConditionEntry> conditions_of_transforms() {
  return {{"flattening", "width / thickness", 1e12, false, 200, transforms(&flattened)},
          {"condition-number", "condition number", 1e12, false, 200, transforms(&pressed)},
          {"nesting", "transforms", 1e4, true, 20, transforms(&nested)}};
}

std::vector<ConditionEntry> conditions_of_secondary_rays() {
  return {{"index-near-1",
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

}  // namespace plumb::studies::stability
