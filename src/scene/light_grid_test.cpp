#include "scene/light_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(PolarLights, StandInTheMiddleOfEqualStepsOfTheta) {
  const auto lights = polarLights(20, 20, LightRegion::Hemisphere);
  ASSERT_EQ(lights.size(), 400u);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double ring = static_cast<double>(i / 20);
    EXPECT_NEAR(lights[i].thetaRadians(), (ring + 0.5) * kPi / 40, 1e-12) << i;
  }
  EXPECT_NEAR(lights[5].phiRadians(), kPi / 2, 1e-12) << "from +x toward +y";
}

TEST(PolarLights, OfTheSphereReachBehindTheWindow) {
  const auto lights = polarLights(30, 60, LightRegion::Sphere);
  ASSERT_EQ(lights.size(), 1800u);
  EXPECT_NEAR(lights.back().thetaRadians(), kPi - kPi / 60, 1e-12);
  // Pairs of rings are mirror images in z = 0.
  for (std::size_t i = 0; i < 60; ++i) EXPECT_NEAR(lights[i].z(), -lights[1740 + i].z(), 1e-12);
}

// Equal-area slices: the mean over the lights is the mean over the region.
TEST(FibonacciLights, AverageLowPolynomialsLikeTheRegion) {
  for (const LightRegion region : {LightRegion::Hemisphere, LightRegion::Sphere}) {
    const auto lights = fibonacciLights(1000, region);
    double x = 0, z = 0, xx = 0, zz = 0;
    for (const Direction& d : lights) {
      x += d.x() / 1000, z += d.z() / 1000;
      xx += d.x() * d.x() / 1000, zz += d.z() * d.z() / 1000;
    }
    EXPECT_NEAR(x, 0, 2e-3);
    EXPECT_NEAR(z, region == LightRegion::Hemisphere ? 0.5 : 0, 1e-9);
    EXPECT_NEAR(xx, 1.0 / 3, 2e-3);
    EXPECT_NEAR(zz, 1.0 / 3, 1e-5);
  }
}

TEST(FibonacciLights, StayOnTheirSideAndApart) {
  for (const int count : {1, 2, 7, 64, 500}) {
    const auto lights = fibonacciLights(count, LightRegion::Hemisphere);
    for (const Direction& d : lights) EXPECT_GT(d.z(), 0) << count;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(angleRadians(lights[i], lights[j]), 1.2 / std::sqrt(count)) << count;
    }
  }
}

TEST(Spacing, OfAPolarGridIsItsThetaStep) {
  const auto lights = polarLights(20, 20, LightRegion::Hemisphere);
  EXPECT_NEAR(spacingRadians(lights), kPi / 40, 1e-9);
}

TEST(Spacing, OfAFibonacciGridIsThatOfItsArea) {
  const auto lights = fibonacciLights(400, LightRegion::Sphere);
  EXPECT_NEAR(spacingRadians(lights) / std::sqrt(4 * kPi / 400), 0.95, 0.1);
}

TEST(Spacing, OfOneLightOrOfOneTwiceIsNone) {
  EXPECT_EQ(spacingRadians(fibonacciLights(1, LightRegion::Sphere)), 0);
  const std::vector<Direction> twice(2);
  EXPECT_EQ(spacingRadians(twice), 0);
}

TEST(NamedLights, AreNumberedFromZero) {
  const auto entries = namedLights(fibonacciLights(3, LightRegion::Sphere));
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[2].name, "light_0002");
  EXPECT_EQ(entries[2].light.intensity, (LinearRgb{1, 1, 1}));
}

}  // namespace
}  // namespace illum
