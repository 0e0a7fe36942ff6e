#include "fit/light_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace illum {
namespace {

using std::numbers::pi;

double sumOf(const std::vector<double>& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

std::vector<Direction> directionsFrom(std::initializer_list<Vector3> vectors) {
  std::vector<Direction> directions;
  for (const Vector3& v : vectors) directions.push_back(Direction::fromVector(v));
  return directions;
}

std::vector<Direction> randomDirections(int count, unsigned seed, double lowestZ) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> z(lowestZ, 1), phi(-pi, pi);
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    directions.push_back(Direction::fromAngles(std::acos(z(random)), phi(random)));
  }
  return directions;
}

std::vector<Direction> ring(int count, double thetaRadians) {
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    directions.push_back(Direction::fromAngles(thetaRadians, 2 * pi * (i + 0.3) / count));
  }
  return directions;
}

// The slow, obviously right version: a fine equal-area lattice, each point to its nearest light.
std::vector<double> weightsByCounting(const std::vector<Direction>& lights, LitCap cap,
                                      int points) {
  std::vector<double> weights(lights.size(), 0.0);
  const double lowest = std::cos(cap.thetaMaxRadians);
  for (int i = 0; i < points; ++i) {
    const double z = lowest + (1 - lowest) * (i + 0.5) / points;
    const Vector3 p = Direction::fromAngles(std::acos(z), i * pi * (3 - std::sqrt(5.0))).vector();
    std::size_t nearest = 0;
    for (std::size_t l = 1; l < lights.size(); ++l) {
      if (dot(p, lights[l].vector()) > dot(p, lights[nearest].vector())) nearest = l;
    }
    weights[nearest] += cap.solidAngle() / points;
  }
  return weights;
}

const std::vector<Direction>& octahedron() {
  static const std::vector<Direction> directions =
      directionsFrom({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  return directions;
}

TEST(LightWeights, OctahedronSharesTheSphereEqually) {
  for (const double w : solidAngleWeights(octahedron(), {pi})) EXPECT_NEAR(w, 4 * pi / 6, 1e-13);
}

TEST(LightWeights, OctahedronOverTheHemisphere) {
  const std::vector<double> w = solidAngleWeights(octahedron(), {pi / 2});
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(w[i], 4 * pi / 12, 1e-13) << i;
  EXPECT_NEAR(w[4], 4 * pi / 6, 1e-13);
  EXPECT_NEAR(w[5], 0, 1e-13);
}

TEST(LightWeights, IcosahedronSharesTheSphereEqually) {
  const double g = std::numbers::phi;
  std::vector<Direction> lights;
  for (const double a : {1.0, -1.0}) {
    for (const double b : {g, -g}) {
      for (const Vector3 v : {Vector3{0, a, b}, Vector3{a, b, 0}, Vector3{b, 0, a}}) {
        lights.push_back(Direction::fromVector(v));
      }
    }
  }
  for (const double w : solidAngleWeights(lights, {pi})) EXPECT_NEAR(w, 4 * pi / 12, 1e-13);
}

TEST(LightWeights, OneLightHasTheWholeCap) {
  const std::vector<Direction> one = directionsFrom({{0.3, 0.2, 0.9}});
  for (const double theta : {0.2, pi / 2, 2.0, pi}) {
    const LitCap cap{theta};
    EXPECT_NEAR(solidAngleWeights(one, cap)[0], cap.solidAngle(), 1e-12) << theta;
  }
  EXPECT_DOUBLE_EQ(litCapOf(one).thetaMaxRadians, pi / 2);
}

TEST(LightWeights, TwoLightsHaveHemispheres) {
  const std::vector<Direction> two = directionsFrom({{0, 0, 1}, {0, 0, -1}});
  EXPECT_NEAR(solidAngleWeights(two, {pi})[0], 2 * pi, 1e-13);
  EXPECT_NEAR(solidAngleWeights(two, {pi / 2})[0], 2 * pi, 1e-13);
  EXPECT_NEAR(solidAngleWeights(two, {pi / 2})[1], 0, 1e-13);
  const std::vector<Direction> near = directionsFrom({{0.01, 0, 1}, {-0.01, 0, 1}});
  for (const double w : solidAngleWeights(near, {1.2})) {
    EXPECT_NEAR(w, LitCap{1.2}.solidAngle() / 2, 1e-12);
  }
}

TEST(LightWeights, DuplicatesShareTheirCell) {
  const std::vector<Direction> lights = directionsFrom({{0, 0, 1},
                                                        {1, 0, 0},
                                                        {0, 0, 2},
                                                        {-1, 0, 0},
                                                        {0, 1, 0},
                                                        {0, -1, 0},
                                                        {0, 0, -1},
                                                        {0, 1e-9, 1}});
  const std::vector<double> w = solidAngleWeights(lights, {pi});
  for (const int i : {0, 2, 7}) EXPECT_NEAR(w[i], 4 * pi / 18, 1e-12) << i;
  for (const int i : {1, 3, 4, 5, 6}) EXPECT_NEAR(w[i], 4 * pi / 6, 1e-12) << i;
  const std::vector<Direction> equal(5, Direction());
  for (const double weight : solidAngleWeights(equal, {1.0})) {
    EXPECT_NEAR(weight, LitCap{1.0}.solidAngle() / 5, 1e-13);
  }
}

// On one great circle through the pole the cells are lunes; each light's share is its share of the
// circle.
TEST(LightWeights, LightsOnAGreatCircleHaveLunes) {
  const double angles[] = {-1.4, -0.9, 0.1, 0.2, 1.3};
  std::vector<Direction> lights;
  for (const double a : angles) {
    lights.push_back(Direction::fromVector({std::sin(a) * 0.6, std::sin(a) * 0.8, std::cos(a)}));
  }
  const double bounds[] = {-pi / 2, -1.15, -0.4, 0.15, 0.75, pi / 2};
  const std::vector<double> w = solidAngleWeights(lights, {pi / 2});
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(w[i], 2 * (bounds[i + 1] - bounds[i]), 1e-7) << i;
  EXPECT_NEAR(sumOf(w), 2 * pi, 1e-12);
}

TEST(LightWeights, RingsShareTheirBelts) {
  std::vector<Direction> lights = ring(200, 1.0);
  lights.push_back(Direction());
  const LitCap cap{1.5};
  const std::vector<double> w = solidAngleWeights(lights, cap);
  for (int i = 0; i < 200; ++i) EXPECT_NEAR(w[i], w[0], 1e-12) << i;
  // With many lights the bisectors approach the circle at theta = 0.5.
  EXPECT_NEAR(w[200], LitCap{0.5}.solidAngle(), 2e-4);
  EXPECT_NEAR(sumOf(w), cap.solidAngle(), 1e-11);
}

TEST(LightWeights, AgreesWithCountingAndSumsToTheCap) {
  for (const double thetaMax : {0.4, 1.1, pi / 2, 1.9, 2.9, pi}) {
    for (const int count : {2, 3, 4, 7, 40}) {
      const std::vector<Direction> lights =
          randomDirections(count, 7 * count, std::max(-1.0, std::cos(thetaMax)));
      const LitCap cap{thetaMax};
      const std::vector<double> w = solidAngleWeights(lights, cap);
      const std::vector<double> counted = weightsByCounting(lights, cap, 40000);
      EXPECT_NEAR(sumOf(w), cap.solidAngle(), 1e-11) << thetaMax << ' ' << count;
      for (int i = 0; i < count; ++i) {
        EXPECT_NEAR(w[i], counted[i], 2e-3 * cap.solidAngle())
            << thetaMax << ' ' << count << ' ' << i;
      }
    }
  }
}

TEST(LightWeights, LightsOutsideTheCapKeepTheirShareOfIt) {
  const std::vector<Direction> lights = randomDirections(9, 5, -1);
  for (const double thetaMax : {0.3, 1.0, 2.2}) {
    const LitCap cap{thetaMax};
    const std::vector<double> w = solidAngleWeights(lights, cap);
    const std::vector<double> counted = weightsByCounting(lights, cap, 40000);
    EXPECT_NEAR(sumOf(w), cap.solidAngle(), 1e-11) << thetaMax;
    for (int i = 0; i < 9; ++i) {
      EXPECT_NEAR(w[i], counted[i], 2e-3 * cap.solidAngle()) << thetaMax << ' ' << i;
    }
  }
}

TEST(LightWeights, SumHoldsForManyRandomAndNearlyDegenerateSets) {
  std::mt19937 random(3);
  std::normal_distribution<double> tiny(0, 1e-5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Direction> lights = randomDirections(1 + trial % 30, trial, 0);
    // Clusters of nearly equal lights, lights on the horizon and nearly on one circle.
    for (int i = 0; i < 5; ++i) {
      lights.push_back(Direction::fromVector({tiny(random), tiny(random), 1}));
      lights.push_back(Direction::fromVector({std::cos(i), std::sin(i), std::abs(tiny(random))}));
      lights.push_back(Direction::fromVector({0.1 * i, tiny(random), 1}));
    }
    const LitCap cap = litCapOf(lights);
    const std::vector<double> w = solidAngleWeights(lights, cap);
    EXPECT_NEAR(sumOf(w), cap.solidAngle(), 1e-8) << trial;
    EXPECT_GE(*std::min_element(w.begin(), w.end()), 0) << trial;
  }
}

TEST(LitCap, EndsHalfASpacingBeyondTheOutermostLight) {
  const std::vector<Direction> lights = ring(24, 0.8);
  const double spacing = angleRadians(lights[0], lights[1]);
  EXPECT_NEAR(meanSpacingRadians(lights), spacing, 1e-14);
  EXPECT_NEAR(litCapOf(lights).thetaMaxRadians, 0.8 + spacing / 2, 1e-14);
  EXPECT_EQ(litCapOf(lights).domain(), LightDomain::Hemisphere);
}

TEST(LitCap, StopsAtTheHorizonUnlessLightsAreBelow) {
  EXPECT_DOUBLE_EQ(litCapOf(ring(6, 1.5)).thetaMaxRadians, pi / 2);
  const std::vector<Direction> below = ring(24, 1.65);
  EXPECT_GT(litCapOf(below).thetaMaxRadians, 1.65);
  EXPECT_EQ(litCapOf(below).domain(), LightDomain::Hemisphere);
}

TEST(LitCap, IsTheSphereWhenLightsLieAllRound) {
  EXPECT_DOUBLE_EQ(litCapOf(octahedron()).thetaMaxRadians, pi);
  const LitCap cap = litCapOf(randomDirections(100, 2, -1));
  EXPECT_DOUBLE_EQ(cap.thetaMaxRadians, pi);
  EXPECT_EQ(cap.domain(), LightDomain::Sphere);
  EXPECT_NEAR(cap.solidAngle(), 4 * pi, 1e-14);
}

TEST(Quadrature, IntegratesOverTheLitDomain) {
  const std::vector<Direction> lights = ring(24, 0.8);
  const LitCap cap = litCapOf(lights);
  double area = 0, height = 0, x2 = 0;
  for (const auto& [d, weight] : litDomainQuadrature(lights)) {
    area += weight;
    height += weight * d.z();
    x2 += weight * d.x() * d.x();
  }
  const double c = std::cos(cap.thetaMaxRadians);
  EXPECT_NEAR(area, cap.solidAngle(), 1e-13);
  EXPECT_NEAR(height, pi * (1 - c * c), 1e-13);
  EXPECT_NEAR(x2, pi * ((1 - c) - (1 - c * c * c) / 3), 1e-13);
}

TEST(Quadrature, GaussLegendreIsExactForItsDegree) {
  for (const int n : {1, 2, 3, 8, 48}) {
    for (const int degree : {0, 2 * n - 2, 2 * n - 1}) {
      double sum = 0;
      for (const auto& [x, w] : gaussLegendre(n)) sum += w * std::pow(x, degree);
      EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0, 1e-14) << n << ' ' << degree;
    }
  }
}

}  // namespace
}  // namespace illum
