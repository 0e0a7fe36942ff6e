#include "illum/basis_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace illum {
namespace {

using std::numbers::pi;

// A function of the chart alone, as one column.
BasisTable tableOfChart(LightDomain domain, int n, const std::function<double(ChartPoint)>& f) {
  BasisTable table(domain, n, 1);
  table.fillChart([&](ChartPoint p, std::span<double> out) { out[0] = f(p); });
  return table;
}

double valueAt(const BasisTable& table, Direction d) {
  std::vector<float> out(table.columns());
  table.evaluate(d, out);
  return out[0];
}

std::vector<Direction> randomDirections(int count, double lowestZ) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> z(lowestZ, 1), phi(-pi, pi);
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    directions.push_back(Direction::fromAngles(std::acos(z(random)), phi(random)));
  }
  return directions;
}

TEST(BasisTable, IsExactAtVertices) {
  for (const int n : {4, 9, 10}) {
    for (const LightDomain domain : {LightDomain::Hemisphere, LightDomain::Sphere}) {
      const BasisTable table = tableOfChart(domain, n, [](ChartPoint p) {
        return std::sin(40 * p.x) + std::cos(70 * p.y) + 3 * p.square;
      });
      for (int square = 0; square < table.squares(); ++square) {
        for (int j = 0; j < n; ++j) {
          for (int i = 0; i < n; ++i) {
            const ChartPoint p{square, static_cast<double>(i) / (n - 1),
                               static_cast<double>(j) / (n - 1)};
            const double r = std::hypot(2 * p.x - 1, 2 * p.y - 1);
            if (r > 1 - 1e-9) continue;
            const float stored =
                table.values()[(square * table.side() + j + 1) * table.side() + i + 1];
            EXPECT_NEAR(valueAt(table, directionFromChart(p)), stored, 1e-6)
                << n << ' ' << square << ' ' << i << ' ' << j;
          }
        }
      }
    }
  }
}

// Catmull-Rom reproduces quadratics, in each coordinate by itself.
TEST(BasisTable, ReproducesQuadratics) {
  const auto f = [](ChartPoint p) {
    return 1 + p.x - 2 * p.y + 3 * p.x * p.x - p.y * p.y + p.x * p.x * p.y * p.y;
  };
  const BasisTable table = tableOfChart(LightDomain::Sphere, 7, f);
  for (const Direction& d : randomDirections(500, -1)) {
    EXPECT_NEAR(valueAt(table, d), f(chartFromDirection(d)), 1e-6) << d.x() << ' ' << d.y();
  }
}

// Slopes from the two sides of every grid line agree; a kink of cubic pieces would show at once.
TEST(BasisTable, IsSmoothAcrossCells) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1, 1);
  const int n = 9;
  const BasisTable table =
      tableOfChart(LightDomain::Hemisphere, n, [&](ChartPoint) { return noise(random); });
  const double h = 1e-3;
  for (int line = 2; line < n - 2; ++line) {
    for (const double along : {0.33, 0.47, 0.61}) {
      const double at = static_cast<double>(line) / (n - 1);
      const auto value = [&](double offset) {
        return valueAt(table, directionFromChart({0, at + offset, along}));
      };
      const double left = (3 * value(0) - 4 * value(-h) + value(-2 * h)) / (2 * h);
      const double right = (-3 * value(0) + 4 * value(h) - value(2 * h)) / (2 * h);
      EXPECT_NEAR(left, right, 0.02) << line << ' ' << along;
    }
  }
}

TEST(BasisTable, GoesLinearlyToTheSouthPole) {
  BasisTable table(LightDomain::Hemisphere, 33, 2);
  table.fill([](Direction d, std::span<double> out) {
    out[0] = 2 + d.x();
    out[1] = 5;
  });
  std::vector<float> at(2), equator(2);
  table.evaluate(Direction::fromVector({0, 0, -1}), at);
  EXPECT_NEAR(at[0], 2, 1e-4);
  EXPECT_NEAR(at[1], 5, 1e-6);
  table.southPole()[0] = 7;
  for (const double phi : {-2.0, 0.0, 1.3}) {
    table.evaluate(Direction::fromAngles(pi / 2 - 1e-9, phi), equator);
    for (const double share : {1e-6, 0.25, 0.5, 0.9, 1.0}) {
      table.evaluate(Direction::fromAngles(pi / 2 * (1 + share), phi), at);
      EXPECT_NEAR(at[0], (1 - share) * equator[0] + share * 7, 1e-5) << phi << ' ' << share;
      EXPECT_NEAR(at[1], 5, 1e-5) << phi << ' ' << share;
    }
  }
  table.evaluate(Direction::fromVector({0, 0, -1}), at);
  EXPECT_EQ(at[0], 7);
}

TEST(BasisTable, TheSouthPoleIsTheEquatorsMean) {
  BasisTable table(LightDomain::Hemisphere, 17, 1);
  table.fill([](Direction d, std::span<double> out) { out[0] = d.x() * d.x() + d.z(); });
  EXPECT_NEAR(table.southPole()[0], 0.5, 1e-3);
  for (float& v : table.values()) v += 1;
  table.setSouthPoleFromEquator();
  EXPECT_NEAR(table.southPole()[0], 1.5, 1e-3);
}

TEST(BasisTable, TheSphereHasTwoSquaresThatMeetAtTheEquator) {
  BasisTable table(LightDomain::Sphere, 33, 1);
  table.fill([](Direction d, std::span<double> out) { out[0] = d.z() * d.x() + d.y(); });
  EXPECT_TRUE(table.southPole().empty());
  for (const Direction& d : randomDirections(500, -1)) {
    EXPECT_NEAR(valueAt(table, d), d.z() * d.x() + d.y(), 2e-4) << d.x() << ' ' << d.z();
  }
  for (const double phi : {0.1, 1.0, -2.2}) {
    EXPECT_NEAR(valueAt(table, Direction::fromAngles(pi / 2 - 1e-12, phi)),
                valueAt(table, Direction::fromAngles(pi / 2 + 1e-12, phi)), 2e-4);
  }
}

TEST(BasisTable, AsksOnlyALittleBeyondTheEquator) {
  for (const int n : {9, 33}) {
    BasisTable table(LightDomain::Hemisphere, n, 1);
    double farthest = 0;
    table.fillChart([&](ChartPoint p, std::span<double> out) {
      farthest = std::max(farthest, std::hypot(2 * p.x - 1, 2 * p.y - 1));
      out[0] = 1;
    });
    const double gridStep = 2.0 / (n - 1);
    EXPECT_GT(farthest, 1 + gridStep) << n;
    EXPECT_LT(farthest, 1 + 3 * gridStep) << n;
    // Corners are 0 whatever the function says.
    EXPECT_EQ(table.values().front(), 0) << n;
  }
}

// Fourth-order convergence is not promised by Catmull-Rom (third is); the figure is held from both
// sides.
TEST(BasisTable, TheErrorFallsWithTheThirdPowerOfTheStep) {
  const auto f = [](Direction d) { return std::sin(3 * d.x() + 1) * std::cos(2 * d.y()); };
  double errors[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    BasisTable table(LightDomain::Hemisphere, i == 0 ? 17 : 33, 1);
    table.fill([&](Direction d, std::span<double> out) { out[0] = f(d); });
    for (const Direction& d : randomDirections(2000, 0)) {
      errors[i] += std::pow(valueAt(table, d) - f(d), 2);
    }
  }
  const double order = std::log2(errors[0] / errors[1]) / 2;
  EXPECT_GT(order, 2.7);
  EXPECT_LT(order, 3.6);
}

}  // namespace
}  // namespace illum
