#include "basis/chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "illum/basis_table.h"

namespace illum {

// tan(theta/2) cos(phi) = sin(theta) cos(phi) / (1 + cos(theta)) = x / (1 + z); on the lower square
// theta is replaced by pi - theta, which changes nothing but the sign of z.
ChartPoint chartFromDirection(Direction d) {
  const double scale = 0.5 / (1 + std::abs(d.z()));
  return {d.z() >= 0 ? 0 : 1, 0.5 + d.x() * scale, 0.5 + d.y() * scale};
}

// With r = tan(theta/2): cos(theta) = (1 - r^2)/(1 + r^2), sin(theta) = 2r/(1 + r^2).
Direction directionFromChart(ChartPoint p) {
  const double u = 2 * p.x - 1, v = 2 * p.y - 1;
  const double rSquared = u * u + v * v;
  const double z = 1 - rSquared;
  return Direction::fromVector({2 * u, 2 * v, p.square == 0 ? z : -z});
}

namespace {

// Distance of [2i, 2i+2] from the centre, along one axis and in doubled coordinates.
int axisDistance(int i, int centre) {
  return std::max({0, 2 * i - centre, centre - (2 * i + 2)});
}

}  // namespace

std::vector<std::uint8_t> reachableSamples(int resolution) {
  const int side = resolution + 2, radius = resolution - 1;
  std::vector<std::uint8_t> reachable(static_cast<std::size_t>(side) * side, 0);
  for (int j = 0; j < resolution - 1; ++j) {
    for (int i = 0; i < resolution - 1; ++i) {
      const std::int64_t dx = axisDistance(i, radius), dy = axisDistance(j, radius);
      if (dx * dx + dy * dy > std::int64_t{radius} * radius) continue;
      for (int row = j; row < j + 4; ++row) {
        std::fill_n(reachable.begin() + static_cast<std::ptrdiff_t>(row) * side + i, 4, 1);
      }
    }
  }
  return reachable;
}

BelowHorizon belowHorizon(Direction d) {
  const double horizontal = std::hypot(d.x(), d.y());
  if (horizontal == 0) return {{}, 1};
  const double share = std::clamp(2 * d.thetaRadians() / std::numbers::pi - 1, 0.0, 1.0);
  return {{0, 0.5 + 0.5 * d.x() / horizontal, 0.5 + 0.5 * d.y() / horizontal}, share};
}

}  // namespace illum
