#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "illum/error.h"
#include "illum/lighting.h"
#include "light/median_cut.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

/// What all lights near give to a surface that faces them all fully.
double facing(const Illumination& lights, Vector3 point) {
  double sum = 0;
  for (const NearLight& light : lights.nearby) sum += light.seenFrom(point).intensity.g;
  return sum;
}

/// A white Lambertian surface at `point`.
double white(const Illumination& lights, Vector3 point, Vector3 normal) {
  double sum = 0;
  for (const NearLight& light : lights.nearby) {
    const DirectionalLight seen = light.seenFrom(point);
    sum += seen.intensity.g * std::max(0.0, dot(seen.toLight.vector(), normal));
  }
  return sum;
}

TEST(NearLight, WeakensAsItsFalloffSays) {
  for (const auto& [falloff, expected] :
       {std::pair{Falloff::InverseSquare, 0.5}, {Falloff::Inverse, 1.0}, {Falloff::None, 2.0}}) {
    const PointLight lamp{{0, 0, 2}, {2, 2, 2}, falloff};
    const auto lights = illuminationOf({{lamp}});
    const DirectionalLight seen = lights.nearby.at(0).seenFrom({0, 0, 0});
    EXPECT_FLOAT_EQ(seen.intensity.g, static_cast<float>(expected));
    EXPECT_EQ(seen.toLight, Direction());
  }
}

TEST(NearLight, GivesNothingAtItsOwnPlace) {
  const auto lights = illuminationOf({{PointLight{{1, 2, 3}, {1, 1, 1}, Falloff::InverseSquare}}});
  EXPECT_EQ(lights.nearby[0].seenFrom({1, 2, 3}).intensity, LinearRgb());
  EXPECT_GT(lights.nearby[0].seenFrom({1, 2, 3.001}).intensity.g, 9e5f);
}

TEST(SpotLight, ShinesWithinItsConeAndFadesAtItsEdge) {
  SpotLight spot{{0, 0, 1}, {0, 0, 0}, 30, 10, {1, 1, 1}, Falloff::None};
  const auto lights = illuminationOf({{spot}});
  const auto at = [&](double degrees) {
    return facing(lights, {std::tan(degrees * kPi / 180), 0, 0});
  };
  EXPECT_EQ(at(0), 1);
  EXPECT_EQ(at(19.9), 1);
  EXPECT_EQ(at(30.1), 0);
  EXPECT_GT(at(22), at(25));
  EXPECT_GT(at(25), at(28));
  EXPECT_NEAR(at(-25), at(25), 1e-6);
  EXPECT_EQ(facing(lights, {0, 0, 2}), 0) << "behind the lamp";
}

TEST(SpotLight, MayHaveAHardEdge) {
  const SpotLight spot{{0, 0, 1}, {0, 0, 0}, 45, 0, {1, 1, 1}, Falloff::None};
  const auto lights = illuminationOf({{spot}});
  EXPECT_EQ(facing(lights, {0.99, 0, 0}), 1);
  EXPECT_EQ(facing(lights, {1.01, 0, 0}), 0);
}

TEST(AreaLights, ActAsPointLightsFarAway) {
  const RectangleLight panel{{0, 0, 100}, {0.5, 0, 0}, {0, -0.25, 0}, {3, 3, 3}, 4, 4};
  const SphereLight ball{{0, 0, 100}, 0.5, {3, 3, 3}, 256};
  EXPECT_NEAR(facing(illuminationOf({{panel}}), {0, 0, 0}), 3e-4, 1e-8);
  EXPECT_NEAR(facing(illuminationOf({{ball}}), {0, 0, 0}), 3e-4, 3e-6);
}

TEST(AreaLights, APanelShinesToOneSide) {
  const RectangleLight panel{{0, 0, 1}, {0.5, 0, 0}, {0, -0.25, 0}, {3, 3, 3}, 4, 4};
  const auto lights = illuminationOf({{panel}});
  EXPECT_GT(facing(lights, {0, 0, 0}), 0);
  EXPECT_EQ(facing(lights, {0, 0, 2}), 0);
}

TEST(AreaLights, AWhiteSurfaceUnderADiscLikePanelHasItsFormFactor) {
  // Over the centre of a square of side 2a at distance h, the form factor of a parallel patch is
  // 4 * (1 / 2 pi) * 2 * (X / sqrt(1 + X^2)) * atan(X / sqrt(1 + X^2)), X = a / h (Howell, B-3).
  const double a = 0.5, h = 0.5, X = a / h, s = std::sqrt(1 + X * X);
  const double formFactor = 4 / (2 * kPi) * (2 * X / s * std::atan(X / s));
  const double radiance = 1, area = 4 * a * a;
  const auto intensity = static_cast<float>(radiance * area / kPi);
  const RectangleLight panel{{0, 0, h}, {a, 0, 0}, {0, -a, 0}, {intensity, intensity, intensity},
                             32,        32};
  EXPECT_NEAR(white(illuminationOf({{panel}}), {0, 0, 0}, {0, 0, 1}), radiance * formFactor, 1e-3);
}

TEST(AreaLights, AWhiteSurfaceFacingABallHasItsFormFactor) {
  // A ball of radiance 1 at distance d gives the irradiance pi (r / d)^2 to a surface that faces
  // it.
  const float intensity = 0.25f * 0.25f;
  const SphereLight ball{{0, 0, 0.5}, 0.25, {intensity, intensity, intensity}, 4000};
  EXPECT_NEAR(white(illuminationOf({{ball}}), {0, 0, 0}, {0, 0, 1}), 0.25, 1e-3);
}

TEST(Illumination, TakesTheSunOutOfTheSky) {
  SkyLight sky;
  sky.model = SkyModel::Preetham;
  const auto lights = illuminationOf({{sky, DirectionalLight()}});
  EXPECT_EQ(lights.environments.size(), 1u);
  EXPECT_EQ(lights.directional.size(), 2u);
  sky.sunlight = false;
  EXPECT_TRUE(illuminationOf({{sky}}).directional.empty());
}

TEST(Illumination, RefusesWhatAFileMayNotHold) {
  EXPECT_THROW(illuminationOf({{SpotLight{{0, 0, 1}, {0, 0, 1}, 30, 6, {}, {}}}}), Error);
  EXPECT_THROW(illuminationOf({{SpotLight{{0, 0, 1}, {0, 0, 0}, 30, 40, {}, {}}}}), Error);
  EXPECT_THROW(illuminationOf({{RectangleLight{{}, {1, 0, 0}, {1, 1, 0}, {}, 4, 4}}}), Error);
  EXPECT_THROW(illuminationOf({{SphereLight{{}, 0, {}, 64}}}), Error);
  EXPECT_THROW(illuminationOf({{PointLight{{std::nan(""), 0, 0}, {}, {}}}}), Error);
  EXPECT_THROW(illuminationOf({{EnvironmentLight()}}), Error);
}

TEST(MedianCut, KeepsAllLight) {
  Picture map({32, 16}, 3);
  for (std::size_t i = 0; i < map.samples().size(); ++i)
    map.samples()[i] = static_cast<float>(i * 7919 % 1013) / 100;
  const Environment environment(map);
  double all = 0, cut = 0;
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 32; ++column) all += environment.texel(column, row).intensity.r;
  }
  const auto lights = medianCut(environment, 50);
  for (const DirectionalLight& light : lights) cut += light.intensity.r;
  EXPECT_EQ(lights.size(), 50u);
  EXPECT_NEAR(cut, all, 1e-5 * all);
}

TEST(MedianCut, FewerRegionsAreThoseOfAShorterCut) {
  Picture map({64, 32}, 3);
  for (std::size_t i = 0; i < map.samples().size(); ++i)
    map.samples()[i] = i % 5 == 0 ? 0 : static_cast<float>(i * 7919 % 1013) / 100;
  const Environment environment(map);
  const MedianCut cut(environment, 300);
  EXPECT_EQ(cut.mostLights(), 300);
  for (const int regions : {1, 2, 3, 17, 128, 300}) {
    const auto longer = cut.lights(regions), shorter = medianCut(environment, regions);
    ASSERT_EQ(longer.size(), static_cast<std::size_t>(regions));
    ASSERT_EQ(longer.size(), shorter.size());
    for (std::size_t i = 0; i < longer.size(); ++i) {
      EXPECT_LT(angleRadians(longer[i].toLight, shorter[i].toLight), 1e-6);
      EXPECT_NEAR(longer[i].intensity.g, shorter[i].intensity.g, 1e-4 * shorter[i].intensity.g);
    }
  }
}

TEST(MedianCut, OneBrightTexelIsOneLight) {
  Picture map({32, 16}, 3);
  map.at(9, 4, 1) = 5;
  const Environment environment(map);
  const auto lights = medianCut(environment, 50);
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_LT(angleRadians(lights[0].toLight, environment.texel(9, 4).toLight), 1e-12);
  EXPECT_EQ(lights[0].intensity, environment.texel(9, 4).intensity);
}

}  // namespace
}  // namespace illum
