#include "illum/vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "illum/error.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

Vector3 randomVector(std::mt19937& random) {
  std::normal_distribution<double> coordinate;
  return {coordinate(random), coordinate(random), coordinate(random)};
}

TEST(Vector, CrossIsRightHanded) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vector3{0, 0, 1}));
  EXPECT_EQ(cross({0, 1, 0}, {0, 0, 1}), (Vector3{1, 0, 0}));
}

// Lagrange: |a x b|^2 + (a . b)^2 = |a|^2 |b|^2, and a x b is normal to both.
TEST(Vector, LagrangeIdentity) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3 a = randomVector(random), b = randomVector(random), c = cross(a, b);
    EXPECT_NEAR(dot(c, c) + dot(a, b) * dot(a, b), dot(a, a) * dot(b, b), 1e-10) << i;
    EXPECT_NEAR(dot(c, a), 0, 1e-12) << i;
    EXPECT_NEAR(dot(c, b), 0, 1e-12) << i;
  }
}

TEST(Direction, PointsToTheViewerByDefault) {
  EXPECT_EQ(Direction().vector(), (Vector3{0, 0, 1}));
}

TEST(Direction, AnglesAreFromZAndFromXTowardY) {
  const double quarter = kPi / 2;
  EXPECT_NEAR(Direction::fromAngles(quarter, 0).x(), 1, 1e-15);
  EXPECT_NEAR(Direction::fromAngles(quarter, quarter).y(), 1, 1e-15);
  EXPECT_NEAR(Direction::fromAngles(0, 1).z(), 1, 1e-15);
  EXPECT_NEAR(Direction::fromAngles(kPi, 0).z(), -1, 1e-15);
}

TEST(Direction, AnglesAndVectorsAreInverse) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Direction a = Direction::fromVector(randomVector(random));
    const Direction b = Direction::fromAngles(a.thetaRadians(), a.phiRadians());
    EXPECT_NEAR(length(a.vector() - b.vector()), 0, 1e-15) << a.x() << ' ' << a.y() << ' ' << a.z();
  }
}

TEST(Direction, NormalisingTwiceChangesNothing) {
  std::mt19937 random(3);
  for (int i = 0; i < 10000; ++i) {
    const Direction a = Direction::fromVector(randomVector(random));
    EXPECT_EQ(Direction::fromVector(a.vector()), a) << a.x() << ' ' << a.y() << ' ' << a.z();
  }
}

TEST(Direction, PhiStaysInItsHalfOpenRange) {
  EXPECT_EQ(Direction::fromVector({0, 0, 1}).phiRadians(), 0);
  EXPECT_EQ(Direction::fromVector({-0.0, -0.0, -1}).phiRadians(), 0);
  EXPECT_EQ(Direction::fromVector({-1, 0, 0}).phiRadians(), kPi);
  EXPECT_EQ(Direction::fromVector({-1, -0.0, 0}).phiRadians(), kPi);
}

TEST(Direction, IsUnitForEveryMagnitude) {
  for (const double scale : {1e-320, 1e-200, 1e-3, 1.0, 1e3, 1e200, 1e308}) {
    const Direction direction = Direction::fromVector({scale, scale, -scale});
    EXPECT_NEAR(length(direction.vector()), 1, 2e-16) << scale;
    EXPECT_NEAR(direction.z(), -1 / std::sqrt(3), 1e-15) << scale;
  }
}

TEST(Direction, RefusesWhatHasNoDirection) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3 v : {Vector3{0, 0, 0}, Vector3{-0.0, 0, 0}, Vector3{infinity, 0, 1},
                          Vector3{0, -infinity, 0}, Vector3{0, 0, nan}}) {
    try {
      Direction::fromVector(v);
      ADD_FAILURE() << v.x << ' ' << v.y << ' ' << v.z;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::Input);
      EXPECT_NE(std::string(error.what()).find("expected a direction"), std::string::npos);
    }
  }
}

TEST(Angle, IsAccurateWhereAcosIsNot) {
  for (const double angle : {0.0, 1e-12, 1e-9, 1e-4, 0.5, kPi / 2, 3.0, kPi - 1e-9}) {
    const Direction a = Direction::fromAngles(kPi / 2, 0.3);
    const Direction b = Direction::fromAngles(kPi / 2, 0.3 + angle);
    EXPECT_NEAR(angleRadians(a, b), angle, 3e-16 + 1e-15 * angle) << angle;
  }
  EXPECT_NEAR(angleRadians(Direction::fromVector({0, 0, 1}), Direction::fromVector({0, 0, -1})),
              kPi, 1e-15);
}

}  // namespace
}  // namespace illum
