#include "illum/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "illum/error.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

void expectNear(Vector3 a, Vector3 b) {
  EXPECT_NEAR(length(a - b), 0, 1e-12)
      << a.x << ' ' << a.y << ' ' << a.z << " instead of " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(RigidTransform, InverseGoesBack) {
  RigidTransform t = rotationAbout(Direction::fromVector({1, -2, 0.5}), 1.3);
  t.translation = {4, 5, -6};
  expectNear(inverse(t).point(t.point({1, 2, 3})), {1, 2, 3});
  expectNear((t * inverse(t)).point({1, 2, 3}), {1, 2, 3});
}

TEST(RigidTransform, ProductsAreChains) {
  RigidTransform a = rotationAbout(Direction::fromVector({0, 1, 0}), 0.4);
  a.translation = {1, 0, 0};
  RigidTransform b = rotationAbout(Direction::fromVector({1, 0, 0}), -1.1);
  b.translation = {0, 2, 0};
  expectNear((a * b).point({3, 1, 2}), a.point(b.point({3, 1, 2})));
  expectNear((a * b).vector({3, 1, 2}), a.vector(b.vector({3, 1, 2})));
}

TEST(RigidTransform, RotationsAreRightHanded) {
  expectNear(rotationAbout(Direction::fromVector({0, 0, 1}), kPi / 2).vector({1, 0, 0}), {0, 1, 0});
  expectNear(rotationAbout(Direction::fromVector({1, 0, 0}), kPi / 2).vector({0, 1, 0}), {0, 0, 1});
  expectNear(rotationAbout(Direction::fromVector({0, 3, 0}), kPi / 2).vector({0, 0, 1}), {1, 0, 0});
}

TEST(LookAt, TurnsMinusZToTheTarget) {
  const RigidTransform camera = lookAt({3, 1, 2}, {0, 0, 0}, {0, 1, 0});
  expectNear(camera.translation, {3, 1, 2});
  expectNear(camera.vector({0, 0, -1}), (-1 / std::sqrt(14.0)) * Vector3{3, 1, 2});
  EXPECT_GT(camera.vector({0, 1, 0}).y, 0);
  EXPECT_NEAR(camera.vector({1, 0, 0}).y, 0, 1e-12) << "the horizon is level";
  expectNear(cross(camera.vector({1, 0, 0}), camera.vector({0, 1, 0})), camera.vector({0, 0, 1}));
}

TEST(LookAt, RefusesWhatDeterminesNoFrame) {
  EXPECT_THROW(lookAt({1, 1, 1}, {1, 1, 1}, {0, 1, 0}), Error);
  EXPECT_THROW(lookAt({0, 5, 0}, {0, 0, 0}, {0, 1, 0}), Error);
  EXPECT_THROW(lookAt({0, 5, 0}, {0, 0, 0}, {0, 0, 0}), Error);
  EXPECT_THROW(lookAt({0, NAN, 0}, {0, 0, 0}, {0, 0, 1}), Error);
}

}  // namespace
}  // namespace illum
