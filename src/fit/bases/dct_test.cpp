#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/bases/light_basis_family.h"
#include "fit/quadrature.h"

namespace illum {
namespace {

using std::numbers::pi;

std::vector<double> onChart(const AnalyticBasis& basis, ChartPoint p) {
  std::vector<double> values(basis.coefficients());
  basis.evaluateOnChart(p, values);
  return values;
}

TEST(ChartCosines, AreOrthonormalOnTheSquare) {
  const int count = 64;
  const auto basis = analyticBasis(BasisFamily::Cosine, count);
  std::vector<double> gram(count * count, 0.0);
  const auto rule = gaussLegendre(32);
  for (const auto& [x, wx] : rule) {
    for (const auto& [y, wy] : rule) {
      const std::vector<double> values = onChart(*basis, {0, (x + 1) / 2, (y + 1) / 2});
      for (int a = 0; a < count; ++a) {
        for (int b = 0; b < count; ++b) gram[a * count + b] += wx * wy / 4 * values[a] * values[b];
      }
    }
  }
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < count; ++b) {
      EXPECT_NEAR(gram[a * count + b], a == b ? 1 : 0, 1e-12) << a << ' ' << b;
    }
  }
}

TEST(ChartCosines, AreSelectedByZonesAndLowestIFirst) {
  const auto basis = analyticBasis(BasisFamily::Cosine, 10);
  const std::pair<int, int> expected[] = {{0, 0}, {0, 1}, {1, 0}, {0, 2}, {1, 1},
                                          {2, 0}, {0, 3}, {1, 2}, {2, 1}, {3, 0}};
  const ChartPoint p{0, 0.37, 0.81};
  const std::vector<double> values = onChart(*basis, p);
  for (int k = 0; k < 10; ++k) {
    const auto [i, j] = expected[k];
    const double scale = (i == 0 ? 1 : std::sqrt(2.0)) * (j == 0 ? 1 : std::sqrt(2.0));
    EXPECT_NEAR(values[k], scale * std::cos(pi * i * p.x) * std::cos(pi * j * p.y), 1e-14) << k;
  }
}

TEST(ChartCosines, TakeDirectionsByTheChart) {
  const auto basis = analyticBasis(BasisFamily::Cosine, 6);
  const Direction d = Direction::fromAngles(1.1, 2.2);
  std::vector<double> values(6);
  basis->evaluate(d, values);
  EXPECT_EQ(values, onChart(*basis, chartFromDirection(d)));
}

TEST(ChartCosines, OnTheSphereEachSquareHasItsOwn) {
  const auto both = analyticBasis(BasisFamily::Cosine, 7, LightDomain::Sphere);
  const auto four = analyticBasis(BasisFamily::Cosine, 4);
  const auto three = analyticBasis(BasisFamily::Cosine, 3);
  const std::vector<double> above = onChart(*both, {0, 0.2, 0.7});
  const std::vector<double> below = onChart(*both, {1, 0.2, 0.7});
  const std::vector<double> upper = onChart(*four, {0, 0.2, 0.7});
  const std::vector<double> lower = onChart(*three, {0, 0.2, 0.7});
  for (int k = 0; k < 7; ++k) {
    EXPECT_EQ(above[k], k < 4 ? upper[k] : 0) << k;
    EXPECT_EQ(below[k], k < 4 ? 0 : lower[k - 4]) << k;
  }
}

}  // namespace
}  // namespace illum
