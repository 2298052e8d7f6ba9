// Nested dielectrics: what a ray crosses from and to, by the stack of the media it is inside of.
#include "tracer/textbook/interiors.hpp"

#include <random>

#include "tests/support/reals.hpp"

namespace plumb::textbook {
namespace {

constexpr InstanceId a = 0;
constexpr InstanceId b = 1;
constexpr InstanceId c = 2;

// Powers of two, so that every ratio is exact.
template <class Real>
constexpr Real eta_a = 2;
template <class Real>
constexpr Real eta_b = 8;
template <class Real>
constexpr Real eta_c = 32;

template <class Real>
class InteriorsStack : public testing::Test {
 protected:
  Real cross_a() { return interiors_.cross(a, eta_a<Real>); }
  Real cross_b() { return interiors_.cross(b, eta_b<Real>); }
  Real cross_c() { return interiors_.cross(c, eta_c<Real>); }
  Interiors<Real> interiors_;
};
TYPED_TEST_SUITE(InteriorsStack, tests::Reals);

TYPED_TEST(InteriorsStack, TheVoidHasIndexOne) { EXPECT_EQ(this->cross_a(), TypeParam(1) / 2); }

TYPED_TEST(InteriorsStack, LeavingTheOnlyMediumLeadsBackToTheVoid) {
  this->cross_a();
  EXPECT_EQ(this->cross_a(), TypeParam(2));
}

TYPED_TEST(InteriorsStack, EnteringASecondMediumLeadsFromTheFirst) {
  this->cross_a();
  EXPECT_EQ(this->cross_b(), TypeParam(2) / 8);
}

TYPED_TEST(InteriorsStack, LeavingTheTopLeadsToTheMediumBelow) {
  this->cross_a();
  this->cross_b();
  EXPECT_EQ(this->cross_b(), TypeParam(8) / 2);
}

TYPED_TEST(InteriorsStack, AfterTheTopTheMediumBelowIsTheTop) {
  this->cross_a();
  this->cross_b();
  this->cross_b();
  EXPECT_EQ(this->cross_a(), TypeParam(2));
}

TYPED_TEST(InteriorsStack, LeavingAMediumThatIsNotOnTopDoesNotBend) {
  this->cross_a();
  this->cross_b();
  EXPECT_EQ(this->cross_a(), TypeParam(1));
}

TYPED_TEST(InteriorsStack, WhatIsLeftBelowTheTopIsGone) {
  this->cross_a();
  this->cross_b();
  this->cross_a();                           // now only b is left
  EXPECT_EQ(this->cross_b(), TypeParam(8));  // to the void, not to a
}

TYPED_TEST(InteriorsStack, LeavingTheMiddleOfThreeKeepsTheOthersInOrder) {
  this->cross_a();
  this->cross_b();
  this->cross_c();
  EXPECT_EQ(this->cross_b(), TypeParam(1));
  EXPECT_EQ(this->cross_c(), TypeParam(32) / 2);
  EXPECT_EQ(this->cross_a(), TypeParam(2));
}

TYPED_TEST(InteriorsStack, AMediumThatWasLeftMayBeEnteredAgain) {
  this->cross_a();
  this->cross_a();
  EXPECT_EQ(this->cross_a(), TypeParam(1) / 2);
  EXPECT_EQ(this->cross_a(), TypeParam(2));
}

TYPED_TEST(InteriorsStack, InstancesOfOneMaterialAreDifferentMedia) {
  using Real = TypeParam;
  this->interiors_.cross(a, eta_a<Real>);
  EXPECT_EQ(this->interiors_.cross(b, eta_a<Real>), Real(1));  // entered, not left: equal indices do not bend
  EXPECT_EQ(this->interiors_.cross(b, eta_a<Real>), Real(1));
  EXPECT_EQ(this->interiors_.cross(a, eta_a<Real>), Real(2));
}

TYPED_TEST(InteriorsStack, ACopyIsCrossedOnItsOwn) {
  auto copy = this->interiors_;
  EXPECT_EQ(copy.cross(a, eta_a<TypeParam>), TypeParam(1) / 2);
  EXPECT_EQ(this->cross_a(), TypeParam(1) / 2);  // entered here, too, not left
}

TYPED_TEST(InteriorsStack, TheRatiosOfAWellNestedWayMultiplyToOne) {
  using Real = TypeParam;
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    Interiors<Real> interiors;
    std::vector<std::pair<InstanceId, Real>> inside;
    Real product = 1;
    int crossings = 0;
    for (InstanceId next = 0; next < 20 || !inside.empty(); ++crossings) {
      const bool enters = next < 20 && (inside.empty() || random() % 2 == 0);
      if (enters) inside.emplace_back(next++, std::uniform_real_distribution<Real>(Real(0.5), 2)(random));
      product *= interiors.cross(inside.back().first, inside.back().second);
      if (!enters) inside.pop_back();
    }
    EXPECT_EQ(crossings, 40);
    // because each of 40 crossings rounds a quotient and a product, and on the way the product, which is 1
    // over the index where the ray is, stays below 2.
    EXPECT_NEAR(static_cast<double>(product), 1, 2 * tests::ulps<Real>(40));
  }
}

}  // namespace
}  // namespace plumb::textbook
