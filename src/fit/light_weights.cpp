#include "fit/light_weights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "fit/spherical_voronoi.h"

namespace illum {
namespace {

using std::numbers::pi;

// Lights that near to each other are one: far below what any light's place is known to.
constexpr double kSameDirectionRadians = 1e-6;
constexpr double kHemisphereReachRadians = 110 * pi / 180;
constexpr int kQuadratureRings = 48;

bool same(Direction a, Direction b) {
  return length(a.vector() - b.vector()) < kSameDirectionRadians;
}

// The different directions among the lights, and which of them each light has.
struct Sites {
  std::vector<Direction> directions;
  std::vector<int> lightsAt;  ///< how many lights share the direction
  std::vector<std::size_t> siteOf;

  explicit Sites(std::span<const Direction> lights) {
    for (const Direction& light : lights) {
      const auto found = std::find_if(directions.begin(), directions.end(),
                                      [&](const Direction& d) { return same(d, light); });
      siteOf.push_back(static_cast<std::size_t>(found - directions.begin()));
      if (found == directions.end()) {
        directions.push_back(light);
        lightsAt.push_back(0);
      }
      ++lightsAt[siteOf.back()];
    }
  }

  double meanSpacing() const {
    if (directions.size() < 2) return 0;
    double sum = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      double nearest = pi;
      for (std::size_t j = 0; j < directions.size(); ++j) {
        if (i != j) nearest = std::min(nearest, angleRadians(directions[i], directions[j]));
      }
      sum += nearest;
    }
    return sum / static_cast<double>(directions.size());
  }
};

}  // namespace

double LitCap::solidAngle() const {
  // 1 - cos, without cancellation for small caps.
  const double s = std::sin(thetaMaxRadians / 2);
  return 4 * pi * s * s;
}

LightDomain LitCap::domain() const {
  return thetaMaxRadians > kHemisphereReachRadians ? LightDomain::Sphere : LightDomain::Hemisphere;
}

double meanSpacingRadians(std::span<const Direction> lights) {
  return Sites(lights).meanSpacing();
}

LitCap litCapOf(std::span<const Direction> lights) {
  assert(!lights.empty());
  double thetaMax = 0;
  for (const Direction& light : lights) thetaMax = std::max(thetaMax, light.thetaRadians());
  const bool allAbove = std::all_of(lights.begin(), lights.end(),
                                    [](const Direction& light) { return light.z() >= 0; });
  const double spacing = meanSpacingRadians(lights);
  if (spacing == 0) return {allAbove ? pi / 2 : pi};
  const double cap = thetaMax + spacing / 2;
  if (allAbove) return {std::min(cap, pi / 2)};
  return {cap >= pi - spacing ? pi : cap};
}

std::vector<double> solidAngleWeights(std::span<const Direction> lights, LitCap cap) {
  assert(!lights.empty());
  const Sites sites(lights);
  const bool wholeSphere = cap.thetaMaxRadians >= pi;
  const double height = std::cos(cap.thetaMaxRadians);
  std::vector<double> areas(sites.directions.size());
  std::vector<Direction> others;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    others = sites.directions;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const SphericalVoronoiCell cell(sites.directions[i], others);
    areas[i] = wholeSphere ? cell.area() : cell.areaAbove(height);
  }
  std::vector<double> weights;
  for (const std::size_t site : sites.siteOf) {
    weights.push_back(areas[site] / sites.lightsAt[site]);
  }
  return weights;
}

std::vector<WeightedDirection> litDomainQuadrature(std::span<const Direction> lights) {
  return capQuadrature(litCapOf(lights).thetaMaxRadians, kQuadratureRings);
}

}  // namespace illum
