#include "scene/light_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

double nearestRadians(std::span<const Direction> lights, std::size_t of) {
  constexpr double kSamePlace = 1e-9;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double angle = angleRadians(lights[of], lights[i]);
    if (i != of && angle > kSamePlace) nearest = std::min(nearest, angle);
  }
  return nearest;
}

}  // namespace

std::vector<Direction> polarLights(int thetaCount, int phiCount, LightRegion region) {
  const double thetaStep = (region == LightRegion::Hemisphere ? kPi / 2 : kPi) / thetaCount;
  const double phiStep = 2 * kPi / phiCount;
  std::vector<Direction> lights;
  for (int ring = 0; ring < thetaCount; ++ring) {
    for (int i = 0; i < phiCount; ++i)
      lights.push_back(Direction::fromAngles((ring + 0.5) * thetaStep, i * phiStep));
  }
  return lights;
}

std::vector<Direction> fibonacciLights(int count, LightRegion region) {
  const double goldenAngle = kPi * (3 - std::sqrt(5.0));
  const double heights = region == LightRegion::Hemisphere ? 1 : 2;
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - heights * (i + 0.5) / count;
    // 1 - z^2 without cancellation near the pole.
    const double across = std::sqrt((1 - z) * (1 + z));
    const double phi = goldenAngle * i;
    lights.push_back(Direction::fromVector({across * std::cos(phi), across * std::sin(phi), z}));
  }
  return lights;
}

double spacingRadians(std::span<const Direction> lights) {
  constexpr std::size_t kAsked = 512;
  const std::size_t step = std::max<std::size_t>(1, lights.size() / kAsked);
  std::vector<double> nearest;
  for (std::size_t i = 0; i < lights.size(); i += step) {
    const double angle = nearestRadians(lights, i);
    if (std::isfinite(angle)) nearest.push_back(angle);
  }
  if (nearest.empty()) return 0;
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

std::vector<LightFileEntry> namedLights(std::span<const Direction> directions) {
  std::vector<LightFileEntry> entries;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    LightFileEntry& entry = entries.emplace_back();
    entry.name = fmt::format("light_{:04}", i);
    entry.light.toLight = directions[i];
    entry.line = static_cast<int>(i + 1);
  }
  return entries;
}

}  // namespace illum
