// Nested dielectrics: the stack of interiors.
#include "tracer/textbook/interiors.hpp"

#include "tests/support/reals.hpp"

namespace plumb::textbook {
namespace {

template <class Real>
class InteriorsOf : public testing::Test {};
TYPED_TEST_SUITE(InteriorsOf, tests::Reals);

constexpr InstanceId outer = 3;
constexpr InstanceId inner = 7;

TYPED_TEST(InteriorsOf, EnteringFromTheVoidAndLeavingAreReciprocal) {
  using Real = TypeParam;
  Interiors<Real> interiors;
  EXPECT_EQ(interiors.cross(outer, Real(1.5)), 1 / Real(1.5));
  EXPECT_EQ(interiors.cross(outer, Real(1.5)), Real(1.5));
}

TYPED_TEST(InteriorsOf, EnteringAnotherBendsByBothIndices) {
  using Real = TypeParam;
  Interiors<Real> interiors;
  interiors.cross(outer, Real(1.5));
  EXPECT_EQ(interiors.cross(inner, Real(1.25)), Real(1.5) / Real(1.25));
  EXPECT_EQ(interiors.cross(inner, Real(1.25)), Real(1.25) / Real(1.5))
      << "leaving the top reaches what is below it";
  EXPECT_EQ(interiors.cross(outer, Real(1.5)), Real(1.5)) << "and then the void";
}

TYPED_TEST(InteriorsOf, LeavingOneThatIsNotOnTopDoesNotBend) {
  using Real = TypeParam;
  Interiors<Real> interiors;
  interiors.cross(outer, Real(1.5));
  interiors.cross(inner, Real(1.25));
  EXPECT_EQ(interiors.cross(outer, Real(1.5)), Real(1));
  EXPECT_EQ(interiors.cross(inner, Real(1.25)), Real(1.25)) << "below the inner one now lies the void";
}

TYPED_TEST(InteriorsOf, ACopyIsIndependent) {
  using Real = TypeParam;
  Interiors<Real> interiors;
  interiors.cross(outer, Real(1.5));
  Interiors<Real> beyond = interiors;
  beyond.cross(outer, Real(1.5));
  EXPECT_EQ(interiors.cross(inner, Real(2)), Real(1.5) / Real(2)) << "a ray that is mirrored stays inside";
}

}  // namespace
}  // namespace plumb::textbook
