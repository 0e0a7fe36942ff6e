#include "basis/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "illum/basis_table.h"

namespace illum {
namespace {

using std::numbers::pi;

TEST(Chart, IsThePapersFormula) {
  for (const double theta : {0.0, 0.3, 1.0, pi / 2}) {
    for (const double phi : {-3.0, -0.5, 0.0, 1.0, 2.5}) {
      const ChartPoint p = chartFromDirection(Direction::fromAngles(theta, phi));
      // The horizon's own rounding decides its square; both have it at the same place.
      if (theta < 1.5) {
        EXPECT_EQ(p.square, 0) << theta << ' ' << phi;
      }
      EXPECT_NEAR(p.x, 0.5 * (std::tan(theta / 2) * std::cos(phi) + 1), 1e-15)
          << theta << ' ' << phi;
      EXPECT_NEAR(p.y, 0.5 * (std::tan(theta / 2) * std::sin(phi) + 1), 1e-15)
          << theta << ' ' << phi;
    }
  }
}

TEST(Chart, TheLowerSquareMirrorsTheta) {
  for (const double theta : {1.7, 2.5, 3.1}) {
    const ChartPoint below = chartFromDirection(Direction::fromAngles(theta, 0.7));
    const ChartPoint above = chartFromDirection(Direction::fromAngles(pi - theta, 0.7));
    EXPECT_EQ(below.square, 1);
    EXPECT_NEAR(below.x, above.x, 1e-15) << theta;
    EXPECT_NEAR(below.y, above.y, 1e-15) << theta;
  }
}

TEST(Chart, PolesAndAxes) {
  const ChartPoint north = chartFromDirection(Direction::fromVector({0, 0, 1}));
  EXPECT_EQ(north.square, 0);
  EXPECT_EQ(north.x, 0.5);
  EXPECT_EQ(north.y, 0.5);
  const ChartPoint south = chartFromDirection(Direction::fromVector({0, 0, -1}));
  EXPECT_EQ(south.square, 1);
  EXPECT_EQ(south.x, 0.5);
  const ChartPoint right = chartFromDirection(Direction::fromVector({1, 0, 0}));
  EXPECT_EQ(right.x, 1);
  EXPECT_EQ(right.y, 0.5);
  const ChartPoint up = chartFromDirection(Direction::fromVector({0, 1, 0}));
  EXPECT_EQ(up.x, 0.5);
  EXPECT_EQ(up.y, 1);
}

TEST(Chart, DirectionsComeBack) {
  std::mt19937 random(1);
  std::normal_distribution<double> coordinate;
  for (int i = 0; i < 1000; ++i) {
    const Direction d =
        Direction::fromVector({coordinate(random), coordinate(random), coordinate(random)});
    EXPECT_LT(angleRadians(directionFromChart(chartFromDirection(d)), d), 1e-15)
        << d.x() << ' ' << d.y() << ' ' << d.z();
  }
}

TEST(Chart, ContinuesPastTheEquator) {
  // r = sqrt(2) at the corner: theta = 2 atan(r).
  const Direction corner = directionFromChart({0, 1, 1});
  EXPECT_NEAR(corner.thetaRadians(), 2 * std::atan(std::numbers::sqrt2), 1e-15);
  EXPECT_NEAR(corner.phiRadians(), pi / 4, 1e-15);
  const Direction lower = directionFromChart({1, 1, 1});
  EXPECT_NEAR(lower.thetaRadians(), pi - 2 * std::atan(std::numbers::sqrt2), 1e-15);
}

TEST(ReachableSamples, HoldEveryStencilOfTheDisc) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> z(0, 1), phi(-pi, pi);
  for (const int n : {4, 5, 6, 17, 33, 34}) {
    const auto reachable = reachableSamples(n);
    std::vector<int> used(reachable.size(), 0);
    for (int i = 0; i < 20000; ++i) {
      const double height = i % 3 == 0 ? 0 : z(random);
      const Direction d = Direction::fromAngles(std::acos(height), phi(random));
      const double r = 1 / (1 + height) * (n - 1) / 2;
      const int column = std::clamp(static_cast<int>((n - 1) / 2.0 + d.x() * r), 0, n - 2);
      const int row = std::clamp(static_cast<int>((n - 1) / 2.0 + d.y() * r), 0, n - 2);
      for (int k = 0; k < 16; ++k) {
        const std::size_t sample = static_cast<std::size_t>(row + k / 4) * (n + 2) + column + k % 4;
        used[sample] = 1;
        ASSERT_EQ(reachable[sample], 1) << n << ' ' << row + k / 4 << ' ' << column + k % 4;
      }
    }
    // Nearly all that are marked are used; the rest belong to cells that the disc hardly touches.
    const auto marked = std::count(reachable.begin(), reachable.end(), 1);
    EXPECT_LE(marked - std::count(used.begin(), used.end(), 1), 60) << n;
  }
}

TEST(ReachableSamples, AreSymmetricAndCounted) {
  for (const auto& [n, expected] : {std::pair{4, 36}, {5, 49}, {9, 117}, {33, 1057}, {65, 3725}}) {
    const auto reachable = reachableSamples(n);
    const int side = n + 2;
    EXPECT_EQ(std::count(reachable.begin(), reachable.end(), 1), expected) << n;
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const auto flag = reachable[row * side + column];
        EXPECT_EQ(flag, reachable[column * side + row]) << n;
        EXPECT_EQ(flag, reachable[(side - 1 - row) * side + column]) << n;
      }
    }
  }
}

}  // namespace
}  // namespace illum
