// Slides "Kameramodell", "Rapid Prototyping" and "Kameratransformation".
#include "tracer/formulas/camera.hpp"

#include "tests/support/reals.hpp"

namespace plumb {
namespace {

template <class Real>
class Camera : public testing::Test {};
TYPED_TEST_SUITE(Camera, tests::Reals);

TYPED_TEST(Camera, APlaneOfWidthOneIsSeenUnderTheFieldOfView) {
  using Real = TypeParam;
  // A right angle sees the width 1 from the distance 1/2.
  EXPECT_NEAR(static_cast<double>(formulas::image_plane_distance(Real(90))), 0.5, tests::ulps<Real>(4));
}

TYPED_TEST(Camera, ThePrototypeGridGivesTheRaysOfA401PixelImage) {
  using Real = TypeParam;
  constexpr int side = 401;
  const Real fov = 60;
  for (const int x : {0, 1, 200, 399, 400}) {
    for (const int y : {0, 17, 200, 400}) {
      const auto on_plane = formulas::image_plane_point<Real>(x, y, side, side);
      const auto model = formulas::camera_ray(on_plane, formulas::image_plane_distance(fov));
      const auto prototype = formulas::prototype_ray<Real>(x - 200, 200 - y, fov);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(static_cast<double>(prototype.direction[axis]),
                    static_cast<double>(side * model.direction[axis]), tests::ulps<Real>(4) * side);
      }
    }
  }
}

TYPED_TEST(Camera, TheMatrixTakesTheCameraAxesToUVAndMinusN) {
  using Real = TypeParam;
  const Vec3<Real> eye(1, 2, 3);
  const Vec3<Real> direction(0, -3, -4);
  const auto m = formulas::camera_matrix(eye, direction, Vec3<Real>(0, 1, 0));
  const Vec3<Real> u(m[0]);
  const Vec3<Real> v(m[1]);
  const Vec3<Real> back(m[2]);
  EXPECT_NEAR(static_cast<double>(glm::dot(u, v)), 0, tests::ulps<Real>(4));
  EXPECT_NEAR(static_cast<double>(glm::dot(u, back)), 0, tests::ulps<Real>(4));
  EXPECT_NEAR(static_cast<double>(back.y), 0.6, tests::ulps<Real>(4));
  EXPECT_NEAR(static_cast<double>(back.z), 0.8, tests::ulps<Real>(4));
  EXPECT_NEAR(static_cast<double>(u.x), 1, tests::ulps<Real>(4));
  EXPECT_EQ(Vec3<Real>(m[3]), eye);
}

}  // namespace
}  // namespace plumb
