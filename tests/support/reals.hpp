// Every real type that is built is tested.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tracer/formulas/ray.hpp"

namespace plumb::tests {

using Reals = testing::Types<float, double, long double>;

/// So many units in the last place of 1, as a tolerance for values about 1 after so many roundings.
template <class Real>
constexpr double ulps(int n) {
  return n * static_cast<double>(std::numeric_limits<Real>::epsilon());
}

/// How many roundings of a place of size 1 a grazed surface does not tell apart: up to 4, none in float.
template <class Real>
int roundings_of_grazed() {
  const Real share = formulas::resolution<Real>() * formulas::grazing_slope<Real>();
  return static_cast<int>(std::min(Real(4), share / std::numeric_limits<Real>::epsilon()));
}

}  // namespace plumb::tests
