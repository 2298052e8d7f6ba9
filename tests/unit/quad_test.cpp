#include "tracer/formulas/quad.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

constexpr Quad ulp = std::numeric_limits<Quad>::epsilon();

double in_ulps(Quad error) { return static_cast<double>(abs(error) / ulp); }

TEST(Quad, HasItsDigits) {
  const Quad one = 1;
  EXPECT_NE(one + ulp, one);
  EXPECT_EQ(one + ulp / 2, one);  // ties go to the even number
  EXPECT_EQ(static_cast<double>(one + ulp), 1);
}

TEST(Quad, FunctionsAreGoodToTheLastDigits) {
  const Quad pi = std::numbers::pi_v<Quad>;
  // because a correctly rounded function is off by half a unit, and libquadmath allows itself one more; the
  // argument's own rounding adds as much
  EXPECT_LE(in_ulps(sin(pi / 6) - Quad(1) / 2), 3);
  EXPECT_LE(in_ulps(cos(pi / 3) - Quad(1) / 2), 3);
  EXPECT_LE(in_ulps(tan(pi / 4) - 1), 3);
  EXPECT_LE(in_ulps(sqrt(Quad(2)) * sqrt(Quad(2)) - 2), 4);
  EXPECT_LE(in_ulps(pow(Quad(2), Quad(1) / 2) - sqrt(Quad(2))), 3);
}

TEST(Quad, PiIsThatOfALongerSeries) {
  // Machin (1706): pi / 4 = 4 arctan(1/5) - arctan(1/239)
  const auto arctan_of_one_over = [](int n) {
    Quad sum = 0;
    Quad power = Quad(1) / n;
    for (int k = 0; k < 60; ++k, power /= n * n) sum += (k % 2 == 0 ? power : -power) / (2 * k + 1);
    return sum;
  };
  const Quad pi = 4 * (4 * arctan_of_one_over(5) - arctan_of_one_over(239));
  // because of some 60 roundings, most of them of small terms
  EXPECT_LE(in_ulps(pi - std::numbers::pi_v<Quad>), 30);
}

TEST(Quad, NothingIsBelowInfinity) {
  EXPECT_LT(Quad(1e300) * Quad(1e300), std::numeric_limits<Quad>::infinity());
  EXPECT_NE(std::numeric_limits<Quad>::quiet_NaN(), std::numeric_limits<Quad>::quiet_NaN());
}

}  // namespace
}  // namespace plumb
