// Every real type that is built is tested.
#pragma once

#include <gtest/gtest.h>

#include <limits>

namespace plumb::tests {

using Reals = testing::Types<float, double, long double>;

/// So many units in the last place of 1, as a tolerance for values about 1 after so many roundings.
template <class Real>
constexpr double ulps(int n) {
  return n * static_cast<double>(std::numeric_limits<Real>::epsilon());
}

}  // namespace plumb::tests
