#include "fit/extension.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

#include "fit/light_weights.h"

namespace illum {
namespace {

using std::numbers::pi;

std::vector<Direction> ringOf(int count, double thetaRadians, double phase = 0) {
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i) {
    lights.push_back(Direction::fromAngles(thetaRadians, 2 * pi * i / count + phase));
  }
  return lights;
}

std::vector<Direction> dome() {
  std::vector<Direction> lights = ringOf(12, 1.4);
  const std::vector<Direction> inner = ringOf(7, 0.8, 0.2);
  lights.insert(lights.end(), inner.begin(), inner.end());
  lights.push_back(Direction());
  return lights;
}

std::vector<Direction> scattered(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> z(0.05, 1), phi(-pi, pi);
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i) {
    lights.push_back(Direction::fromAngles(std::acos(z(random)), phi(random)));
  }
  return lights;
}

double extended(const Extension& e, std::size_t m, const std::vector<Direction>& lights,
                const std::function<double(Direction)>& f) {
  double sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += e.row(m)[i] * f(lights[i]);
  return sum;
}

TEST(Extension, KeepsConstants) {
  for (const auto& lights :
       {dome(), scattered(1, 1), scattered(2, 2), scattered(5, 3), scattered(60, 4),
        std::vector<Direction>(3), ringOf(30, pi / 2), ringOf(30, 1.7)}) {
    const Extension e = extendBelowHorizon(lights);
    ASSERT_GE(e.directions.size(), 8U);
    ASSERT_LE(e.directions.size(), 500U);
    ASSERT_EQ(e.matrix.size(), e.directions.size() * lights.size());
    for (std::size_t m = 0; m < e.directions.size(); ++m) {
      double sum = 0;
      for (const double w : e.row(m)) {
        EXPECT_GE(w, 0);
        sum += w;
      }
      EXPECT_NEAR(sum, 1, 1e-14) << lights.size() << " lights, row " << m;
      EXPECT_LT(e.directions[m].z(), 0);
    }
  }
}

// A ring at the equator with f = 2 + cos(phi): linear in theta from f to its mean, 2.
TEST(Extension, GoesLinearlyFromTheEquatorToItsMeanAtTheSouthPole) {
  const std::vector<Direction> lights = ringOf(90, pi / 2);
  const auto f = [](Direction d) { return 2 + std::cos(d.phiRadians()); };
  const Extension e = extendBelowHorizon(lights);
  for (std::size_t m = 0; m < e.directions.size(); ++m) {
    const double share = e.directions[m].thetaRadians() / (pi / 2) - 1;
    EXPECT_NEAR(extended(e, m, lights, f), 2 + (1 - share) * std::cos(e.directions[m].phiRadians()),
                7e-4)  // the chord of a cosine over 4 degrees
        << m;
  }
}

TEST(Extension, InterpolatesLinearlyInAzimuth) {
  const std::vector<Direction> lights = ringOf(4, 1.5);
  const std::vector<std::size_t> boundary = boundaryLights(lights);
  EXPECT_EQ(boundary.size(), 4U);
  const double phis[] = {0, pi / 8, pi / 4, pi / 2, -pi / 8};
  const std::vector<double> expected[] = {
      {1, 0, 0, 0}, {0.75, 0.25, 0, 0}, {0.5, 0.5, 0, 0}, {0, 1, 0, 0}, {0.75, 0, 0, 0.25}};
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> w = boundaryWeights(lights, boundary, phis[i]);
    for (int l = 0; l < 4; ++l) EXPECT_NEAR(w[l], expected[i][l], 1e-14) << phis[i] << ' ' << l;
  }
}

TEST(Extension, TheMeanCountsGapsNotLights) {
  // Lights at 0, 90 and 180 degrees: half of the circle has no light of its own.
  const std::vector<Direction> lights = {Direction::fromAngles(1.5, 0),
                                         Direction::fromAngles(1.5, pi / 2),
                                         Direction::fromAngles(1.5, pi)};
  const Extension e = extendBelowHorizon(lights, 0.05);
  const std::size_t last = e.directions.size() - 1;
  ASSERT_GT(e.directions[last].thetaRadians(), 0.95 * pi);
  const double share = e.directions[last].thetaRadians() / (pi / 2) - 1;
  // The middle light: a quarter of the mean; the outer ones three eighths each.
  const std::vector<double> at =
      boundaryWeights(lights, boundaryLights(lights), e.directions[last].phiRadians());
  EXPECT_NEAR(e.row(last)[1], share * 0.25 + (1 - share) * at[1], 1e-12);
  EXPECT_NEAR(e.row(last)[0], share * 0.375 + (1 - share) * at[0], 1e-12);
}

TEST(Extension, OnlyTheOutermostLightsOfTheirSectorBound) {
  const std::vector<std::size_t> boundary = boundaryLights(dome());
  ASSERT_EQ(boundary.size(), 12U);
  for (const std::size_t i : boundary) EXPECT_LT(i, 12U);

  // Where the outer ring has a wide hole, the inner light there bounds.
  std::vector<Direction> holed = ringOf(24, 1.3);
  const Direction inner = Direction::fromAngles(1.0, 0);
  holed.erase(holed.begin() + 22, holed.end());
  holed.erase(holed.begin(), holed.begin() + 3);
  holed.push_back(inner);
  const std::vector<std::size_t> withInner = boundaryLights(holed);
  EXPECT_EQ(withInner.size(), holed.size());
  // Ordered by azimuth.
  for (std::size_t b = 1; b < withInner.size(); ++b) {
    EXPECT_LT(holed[withInner[b - 1]].phiRadians(), holed[withInner[b]].phiRadians());
  }
}

TEST(Extension, RepeatedLightsBoundOnce) {
  std::vector<Direction> lights = ringOf(6, 1.5);
  lights.push_back(lights[2]);
  EXPECT_EQ(boundaryLights(lights).size(), 6U);
}

TEST(Extension, BeginsBelowALitCapThatReachesBelowTheHorizon) {
  const std::vector<Direction> lights = ringOf(40, 1.8);
  const double edge = litCapOf(lights).thetaMaxRadians;
  const Extension e = extendBelowHorizon(lights);
  for (const Direction& d : e.directions) EXPECT_GE(d.thetaRadians(), edge);
}

TEST(Extension, IsEmptyWhenTheWholeSphereIsLit) {
  const std::vector<Direction> lights = {
      Direction::fromVector({1, 0, 0}), Direction::fromVector({-1, 0, 0}),
      Direction::fromVector({0, 1, 0}), Direction::fromVector({0, -1, 0}),
      Direction::fromVector({0, 0, 1}), Direction::fromVector({0, 0, -1})};
  EXPECT_TRUE(extendBelowHorizon(lights).directions.empty());
}

}  // namespace
}  // namespace illum
