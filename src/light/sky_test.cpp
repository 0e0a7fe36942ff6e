#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "illum/environment.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

SkyLight makeSky(SkyModel model, double sunDegreesFromZenith = 40) {
  SkyLight sky;
  sky.model = model;
  const double t = sunDegreesFromZenith * kPi / 180;
  sky.sun = Direction::fromVector({std::sin(t), std::cos(t), 0});
  sky.ground = 0;
  return sky;
}

/// From the zenith, in the sun's plane toward the sun.
Direction at(double degrees) {
  const double t = degrees * kPi / 180;
  return Direction::fromVector({std::sin(t), std::cos(t), 0});
}

double luminance(LinearRgb c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

TEST(Sky, OvercastIsThreeTimesBrighterAboveThanAtTheHorizon) {
  const auto radiance = skyRadiance(makeSky(SkyModel::Overcast));
  // Closed form: (1 + 2 cos) / 3 has the irradiance 7 pi / 9, so that a white plane gives Lz = 9
  // / 7.
  EXPECT_NEAR(radiance(at(0)).g, 9.0 / 7, 1e-4);
  EXPECT_NEAR(radiance(at(60)).g, 9.0 / 7 * 2 / 3, 1e-4);
  EXPECT_NEAR(radiance(at(90 - 1e-7)).g, 3.0 / 7, 1e-4);
}

TEST(Sky, ClearHasTheRatiosOfTheStandard) {
  const auto radiance = skyRadiance(makeSky(SkyModel::Clear));
  const double zenith = radiance(at(0)).g;
  const auto f = [](double degrees) {
    const double g = degrees * kPi / 180;
    return 0.91 + 10 * std::exp(-3 * g) + 0.45 * std::cos(g) * std::cos(g);
  };
  EXPECT_NEAR(1 - std::exp(-0.32), 0.27385, 1e-5);
  EXPECT_NEAR(radiance(at(40)).g / zenith,
              f(0) * (1 - std::exp(-0.32 / std::cos(40 * kPi / 180))) / (f(40) * 0.27385), 1e-3);
  EXPECT_NEAR(radiance(at(-60)).g / zenith, f(100) * (1 - std::exp(-0.64)) / (f(40) * 0.27385),
              1e-3);
}

TEST(Sky, PreethamHasItsZenithLuminanceAndColour) {
  // The paper's formulas by hand for T = 3 and a sun 30 degrees from the zenith; chromaticities are
  // ratios and so do not depend on our units.
  SkyLight sky = makeSky(SkyModel::Preetham, 30);
  sky.turbidity = 3;
  const LinearRgb zenith = skyRadiance(sky)(at(0));
  const double t = kPi / 6;
  const double x = 9 * (0.00166 * t * t * t - 0.00375 * t * t + 0.00209 * t) +
                   3 * (-0.02903 * t * t * t + 0.06377 * t * t - 0.03202 * t + 0.00394) +
                   0.11693 * t * t * t - 0.21196 * t * t + 0.06052 * t + 0.25886;
  const double X = 0.4124 * zenith.r + 0.3576 * zenith.g + 0.1805 * zenith.b;
  const double Y = 0.2126 * zenith.r + 0.7152 * zenith.g + 0.0722 * zenith.b;
  const double Z = 0.0193 * zenith.r + 0.1192 * zenith.g + 0.9505 * zenith.b;
  EXPECT_NEAR(X / (X + Y + Z), x, 1e-4);
  EXPECT_GT(zenith.b, zenith.r) << "the zenith is blue";
}

TEST(Sky, HazeReddensAndWeakensTheSun) {
  double before = 1e30, redness = 0;
  for (const double turbidity : {2.0, 4.0, 8.0}) {
    SkyLight sky = makeSky(SkyModel::Preetham, 70);
    sky.turbidity = turbidity;
    const LinearRgb sun = sunlightOf(sky)->intensity;
    EXPECT_LT(luminance(sun), before) << turbidity;
    EXPECT_GT(sun.r / sun.b, redness) << turbidity;
    before = luminance(sun);
    redness = sun.r / sun.b;
  }
}

TEST(Sky, ClearSunIsSeveralTimesStrongerThanItsSky) {
  // Measured daylight under a high sun: direct illuminance on the ground is three to ten times the
  // sky's; the model's sky is known to be on the bright side (G. Zotti et al. 2007).
  SkyLight sky = makeSky(SkyModel::Preetham, 30);
  sky.turbidity = 2.5;
  const double sun = luminance(sunlightOf(sky)->intensity) * std::cos(kPi / 6);
  EXPECT_GT(sun, 2.5);
  EXPECT_LT(sun, 10);
}

class EverySky : public testing::TestWithParam<SkyModel> {};

TEST_P(EverySky, LightsAWhitePlaneBelowWithOne) {
  for (const double sun : {0.0, 35.0, 80.0}) {
    SkyLight sky = makeSky(GetParam(), sun);
    sky.up = Direction::fromVector({0, 0, 1});
    sky.sun = Direction::fromAngles(sun * kPi / 180, 0.4);
    const Environment map = skyEnvironment(sky);
    double value = 0;
    for (int row = 0; row < map.size().height; ++row) {
      for (int column = 0; column < map.size().width; ++column) {
        const DirectionalLight light = map.texel(column, row);
        value += luminance(light.intensity) * std::max(0.0, light.toLight.z());
      }
    }
    EXPECT_NEAR(value, 1, 4e-3) << "sun " << sun << " degrees from the zenith";
  }
}

TEST_P(EverySky, IsSymmetricalAboutTheSunsPlane) {
  const auto radiance = skyRadiance(makeSky(GetParam()));
  const auto left = radiance(Direction::fromVector({0.3, 0.5, 0.7}));
  const auto right = radiance(Direction::fromVector({0.3, 0.5, -0.7}));
  EXPECT_NEAR(left.g, right.g, 1e-6);
}

TEST_P(EverySky, GroundGivesBackItsAlbedo) {
  SkyLight sky = makeSky(GetParam());
  sky.ground = 0.5;
  const Direction down = Direction::fromVector({0.1, -1, 0});
  double sunOnGround = 0;
  if (const auto sun = sunlightOf(sky))
    sunOnGround = luminance(sun->intensity) * std::cos(40 * kPi / 180);
  EXPECT_NEAR(luminance(skyRadiance(sky)(down)), 0.5 * (1 + sunOnGround), 1e-4);
  sky.ground = 0;
  EXPECT_EQ(luminance(skyRadiance(sky)(down)), 0);
}

TEST_P(EverySky, IsNowhereNegativeOrInfinite) {
  for (const double sun : {0.0, 45.0, 89.0, 90.0}) {
    for (const double turbidity : {2.0, 10.0}) {
      SkyLight sky = makeSky(GetParam(), sun);
      sky.turbidity = turbidity;
      const auto radiance = skyRadiance(sky);
      for (double degrees = -89.99; degrees < 90; degrees += 3) {
        const double value = luminance(radiance(at(degrees)));
        EXPECT_TRUE(std::isfinite(value) && value >= 0)
            << value << " at " << degrees << ", sun at " << sun << ", turbidity " << turbidity;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EverySky,
                         testing::Values(SkyModel::Overcast, SkyModel::Clear, SkyModel::Preetham));

TEST(Sky, RefusesASunBelowTheHorizonAndOtherHaze) {
  EXPECT_THROW(skyRadiance(makeSky(SkyModel::Clear, 91)), Error);
  EXPECT_NO_THROW(skyRadiance(makeSky(SkyModel::Overcast, 91)));
  SkyLight sky = makeSky(SkyModel::Preetham);
  for (const double turbidity : {1.0, 20.0, std::nan("")}) {
    sky.turbidity = turbidity;
    EXPECT_THROW(skyRadiance(sky), Error) << turbidity;
  }
}

}  // namespace
}  // namespace illum
