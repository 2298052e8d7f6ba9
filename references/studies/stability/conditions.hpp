// What the entries of the catalogue are made of, and the entries of each kind.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "references/studies/stability/catalogue.hpp"

namespace plumb::studies::stability {

template <class Real>
using Is = std::type_identity<Real>;

struct Words {
  const char *id, *source, *cause, *remedy;
};

inline constexpr Words lecture{"lecture", "the lecture", "coordinates carry few bits across the object",
                               "a wider real type, or coordinates near the object"};

/// The same rays at every value, so that bisection sees one condition change.
Probe of_rays(Experiment experiment);

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

Method by_embree(const char* id, const char* source, Experiment experiment);

/// Distance, size, place and angle of a sphere.
std::vector<ConditionEntry> conditions_of_spheres();
std::vector<ConditionEntry> conditions_of_boxes();
/// Matrices that flatten, and long products of them.
std::vector<ConditionEntry> conditions_of_transforms();
/// Refraction, and long paths.
std::vector<ConditionEntry> conditions_of_secondary_rays();

}  // namespace plumb::studies::stability
