#include "illum/environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "illum/error.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

Picture uniform(Size size, float value) {
  Picture map(size, 3);
  for (float& s : map.samples()) s = value;
  return map;
}

/// A white Lambertian surface under all texels.
double valueOfWhite(const Environment& environment, Direction normal) {
  double sum = 0;
  for (int row = 0; row < environment.size().height; ++row) {
    for (int column = 0; column < environment.size().width; ++column) {
      const DirectionalLight light = environment.texel(column, row);
      sum += light.intensity.g * std::max(0.0, dot(light.toLight.vector(), normal.vector()));
    }
  }
  return sum;
}

TEST(Environment, UniformLightIsAWhiteFurnace) {
  const Environment white(uniform({128, 64}, 1));
  for (const Vector3 n : {Vector3{0, 1, 0}, {0, 0, 1}, {1, -2, 0.5}})
    EXPECT_NEAR(valueOfWhite(white, Direction::fromVector(n)), 1, 1e-3) << n.x << n.y << n.z;
}

TEST(Environment, SolidAnglesCoverTheSphere) {
  const Size size{6, 3};
  double sum = 0;
  for (int row = 0; row < size.height; ++row) sum += size.width * texelSolidAngle(row, size);
  EXPECT_NEAR(sum, 4 * kPi, 1e-12);
}

TEST(Environment, TexelsComeFromWhereTheConventionsSay) {
  const Environment map(uniform({4, 2}, 3), {}, {1, 2, 3});
  const DirectionalLight light = map.texel(2, 0);  // u = 5/8, v = 1/4
  EXPECT_NEAR(light.toLight.x(), 0.5, 1e-15);
  EXPECT_NEAR(light.toLight.y(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(light.toLight.z(), -0.5, 1e-15);
  EXPECT_NEAR(light.intensity.r, 3 * (kPi / 2) / kPi, 1e-6);
  EXPECT_NEAR(light.intensity.b, 9 * (kPi / 2) / kPi, 1e-6);
}

TEST(Environment, RadianceIsFoundWhereTexelsAre) {
  Picture picture({64, 32}, 3);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) picture.at(x, y, 1) = static_cast<float>(64 * y + x);
  }
  const Environment map(picture, rotationAbout(Direction::fromVector({1, 2, 3}), 1.1));
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x)
      EXPECT_EQ(map.radianceFrom(map.texel(x, y).toLight).g, 64 * y + x) << x << ", " << y;
  }
}

TEST(Environment, TurningIsRotatingEveryLight) {
  const Environment map(uniform({8, 4}, 1), objectFromMap(30, Direction()));
  const RigidTransform rotation = rotationAbout(Direction::fromVector({3, 1, 2}), 2);
  const Direction expected = rotation.direction(map.texel(5, 1).toLight);
  EXPECT_LT(angleRadians(map.turned(rotation).texel(5, 1).toLight, expected), 1e-12);
}

TEST(Environment, RotationTurnsTheMiddleTowardTheLeft) {
  const Direction y = Direction::fromVector({0, 1, 0});
  const Vector3 middle = objectFromMap(90, y).vector({0, 0, -1});
  EXPECT_NEAR(middle.x, -1, 1e-15);
  EXPECT_NEAR(middle.z, 0, 1e-15);
}

TEST(Environment, UpIsWhereTheTopGoes) {
  for (const Vector3 v : {Vector3{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {1, -2, 3}}) {
    const Direction up = Direction::fromVector(v);
    const Vector3 top = objectFromMap(40, up).vector({0, 1, 0});
    EXPECT_NEAR(dot(top, up.vector()), 1, 1e-12) << v.x << ' ' << v.y << ' ' << v.z;
  }
}

TEST(Environment, RefusesOtherShapesAndNumbers) {
  EXPECT_THROW(Environment(uniform({64, 64}, 1)), Error);
  EXPECT_THROW(Environment{Picture()}, Error);
  for (const float value : {std::numeric_limits<float>::infinity(), std::nanf("")}) {
    Picture map = uniform({8, 4}, 1);
    map.at(3, 2, 1) = value;
    try {
      Environment{map};
      FAIL() << "expected an Error for " << value;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("column 3, row 2"));
    }
  }
}

}  // namespace
}  // namespace illum
