#include "fit/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/extension.h"
#include "fit/light_weights.h"
#include "illum/error.h"

namespace illum {
namespace {

using std::numbers::pi;

std::vector<Direction> lattice(int count, double lowestZ) {
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (1 - lowestZ) * (i + 0.5) / count;
    lights.push_back(Direction::fromAngles(std::acos(z), i * pi * (3 - std::sqrt(5.0))));
  }
  return lights;
}

// The paper's grids: theta over [0, thetaMax] in cells, phi all round.
std::vector<Direction> polarGrid(int thetas, int phis, double thetaMax) {
  std::vector<Direction> lights;
  for (int t = 0; t < thetas; ++t) {
    for (int p = 0; p < phis; ++p) {
      lights.push_back(Direction::fromAngles(thetaMax * (t + 0.5) / thetas, 2 * pi * p / phis));
    }
  }
  return lights;
}

// Largest deviation of projection o evaluation from the identity.
double worstDeviation(const std::vector<Direction>& lights, const AnalyticBasis& basis) {
  const std::vector<double> rows = projectionOperator(lights, basis, false);
  const std::size_t count = static_cast<std::size_t>(basis.coefficients());
  std::vector<double> product(count * count, 0.0), values(count);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    basis.evaluate(lights[i], values);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t j = 0; j < count; ++j) {
        product[k * count + j] += rows[k * lights.size() + i] * values[j];
      }
    }
  }
  double worst = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t j = 0; j < count; ++j) {
      worst = std::max(worst, std::abs(product[k * count + j] - (j == k ? 1 : 0)));
    }
  }
  return worst;
}

TEST(Projection, RecoversHarmonicsFromFullGrids) {
  const auto sh = analyticBasis(BasisFamily::SphericalHarmonics, 25, LightDomain::Sphere);
  const struct {
    std::vector<Direction> lights;
    double budget;
  } cases[] = {{polarGrid(20, 20, pi), 0.06},
               {polarGrid(30, 60, pi), 0.02},
               {lattice(200, -1), 0.01},
               {lattice(1200, -1), 0.001}};
  for (const auto& [lights, budget] : cases) {
    const double worst = worstDeviation(lights, *sh);
    EXPECT_LT(worst, budget) << lights.size();
    EXPECT_GT(worst, budget / 8) << lights.size();
  }
}

TEST(Projection, RecoversHemisphericalHarmonicsFromTheUpperHemisphere) {
  const auto hsh = analyticBasis(BasisFamily::HemisphericalHarmonics, 16);
  // The lit cap ends half a spacing beyond the last ring, a little above the horizon.
  EXPECT_LT(worstDeviation(polarGrid(20, 60, pi / 2), *hsh), 0.08);
  EXPECT_LT(worstDeviation(lattice(1000, 0), *hsh), 0.03);
}

TEST(Projection, OfAConstantIsTheConstantTimesTheFirstFunctionsIntegral) {
  const auto sh = analyticBasis(BasisFamily::SphericalHarmonics, 9, LightDomain::Hemisphere);
  const std::vector<Direction> lights = polarGrid(15, 30, pi / 2);
  for (const bool extension : {false, true}) {
    const std::vector<double> rows = projectionOperator(lights, *sh, extension);
    double c00 = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) c00 += rows[i];
    const double area = extension ? 4 * pi : litCapOf(lights).solidAngle();
    EXPECT_NEAR(c00, area / std::sqrt(4 * pi), 1e-10) << extension;
  }
}

// With the extension, reconstruction at the horizon has no jump to 0 to follow.
TEST(Projection, TheExtensionKeepsTheHorizonFromRinging) {
  const auto sh = analyticBasis(BasisFamily::SphericalHarmonics, 25, LightDomain::Hemisphere);
  const std::vector<Direction> lights = polarGrid(15, 30, pi / 2);
  std::vector<double> values(25);
  double worst[2] = {0, 0};
  for (const bool extension : {false, true}) {
    const std::vector<double> rows = projectionOperator(lights, *sh, extension);
    for (std::size_t l = 0; l < lights.size(); ++l) {
      sh->evaluate(lights[l], values);
      double sum = 0;
      for (std::size_t k = 0; k < 25; ++k) {
        double coefficient = 0;  // of the constant 1
        for (std::size_t i = 0; i < lights.size(); ++i) coefficient += rows[k * lights.size() + i];
        sum += coefficient * values[k];
      }
      worst[extension] = std::max(worst[extension], std::abs(sum - 1));
    }
  }
  EXPECT_GT(worst[0], 0.3);
  EXPECT_LT(worst[1], 0.02);
}

TEST(Projection, RefusesCosines) {
  const auto dct = analyticBasis(BasisFamily::Cosine, 9);
  EXPECT_THROW(projectionOperator(lattice(9, 0), *dct, false), Error);
}

}  // namespace
}  // namespace illum
