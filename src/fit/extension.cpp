#include "fit/extension.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "fit/light_weights.h"

namespace illum {
namespace {

using std::numbers::pi;

constexpr int kMinVirtualLights = 8, kMaxVirtualLights = 500;
// Lights of a ring differ by what they were measured with; so much is not "further out".
constexpr double kSameThetaRadians = 0.5 * pi / 180;

// b - a, into [0, 2 pi).
double turnFrom(double a, double b) {
  return b - a - 2 * pi * std::floor((b - a) / (2 * pi));
}

double azimuthDistance(double a, double b) {
  const double turn = turnFrom(a, b);
  return std::min(turn, 2 * pi - turn);
}

// Mean over all azimuths of the piecewise linear boundary value: half of the gaps on both sides.
std::vector<double> boundaryMean(std::span<const Direction> lights,
                                 std::span<const std::size_t> boundary) {
  std::vector<double> weights(lights.size(), 0.0);
  for (std::size_t b = 0; b < boundary.size(); ++b) {
    const std::size_t here = boundary[b], next = boundary[(b + 1) % boundary.size()];
    const double gap = boundary.size() == 1
                           ? 2 * pi
                           : turnFrom(lights[here].phiRadians(), lights[next].phiRadians());
    weights[here] += gap / (4 * pi);
    weights[next] += gap / (4 * pi);
  }
  return weights;
}

// Equal areas of about a hexagon of the given spacing each, between z = -1 and `top`.
std::vector<Direction> latticeBelow(double top, double spacing) {
  const double area = 2 * pi * (1 + top);
  const double wanted = std::ceil(area / (std::numbers::sqrt3 / 2 * spacing * spacing));
  const int count =
      static_cast<int>(std::clamp<double>(wanted, kMinVirtualLights, kMaxVirtualLights));
  std::vector<Direction> directions;
  for (int i = 0; i < count; ++i) {
    const double z = top - (1 + top) * (i + 0.5) / count;
    const double phi = i * pi * (3 - std::sqrt(5.0));  // the golden angle
    directions.push_back(Direction::fromAngles(std::acos(z), phi));
  }
  return directions;
}

}  // namespace

std::vector<std::size_t> boundaryLights(std::span<const Direction> lights) {
  const double spacing = meanSpacingRadians(lights);
  std::vector<std::size_t> boundary;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double theta = lights[i].thetaRadians(), phi = lights[i].phiRadians();
    // Along the circle of latitude an arc of `spacing` is that much azimuth; near the pole, all of
    // it.
    const double sine = std::sin(theta);
    const double sector = spacing < pi * sine ? spacing / sine : pi;
    bool outermost = true;
    for (std::size_t j = 0; j < lights.size() && outermost; ++j) {
      const bool further = lights[j].thetaRadians() > theta + kSameThetaRadians;
      const bool repeated = j < i && angleRadians(lights[i], lights[j]) < 1e-6;
      outermost = !repeated && !(further && azimuthDistance(lights[j].phiRadians(), phi) <= sector);
    }
    if (outermost) boundary.push_back(i);
  }
  std::sort(boundary.begin(), boundary.end(), [&](std::size_t a, std::size_t b) {
    return lights[a].phiRadians() < lights[b].phiRadians();
  });
  return boundary;
}

std::vector<double> boundaryWeights(std::span<const Direction> lights,
                                    std::span<const std::size_t> boundary, double phiRadians) {
  std::vector<double> weights(lights.size(), 0.0);
  // The last boundary light at or before the azimuth, going round.
  std::size_t before = 0;
  double distance = 2 * pi;
  for (std::size_t b = 0; b < boundary.size(); ++b) {
    const double turn = turnFrom(lights[boundary[b]].phiRadians(), phiRadians);
    if (turn <= distance) {
      distance = turn;
      before = b;
    }
  }
  const std::size_t here = boundary[before], next = boundary[(before + 1) % boundary.size()];
  const double gap = turnFrom(lights[here].phiRadians(), lights[next].phiRadians());
  const double share = gap > 0 ? std::min(1.0, distance / gap) : 0;
  weights[here] += 1 - share;
  weights[next] += share;
  return weights;
}

Extension extendBelowHorizon(std::span<const Direction> lights, double spacingRadians) {
  assert(!lights.empty());
  const LitCap cap = litCapOf(lights);
  Extension extension;
  extension.lights = static_cast<int>(lights.size());
  if (cap.thetaMaxRadians >= pi) return extension;
  double spacing = spacingRadians > 0 ? spacingRadians : meanSpacingRadians(lights);
  if (spacing == 0) spacing = pi / 4;
  const double edge = std::max(pi / 2, cap.thetaMaxRadians);
  extension.directions = latticeBelow(std::cos(edge), spacing);

  const std::vector<std::size_t> boundary = boundaryLights(lights);
  const std::vector<double> mean = boundaryMean(lights, boundary);
  for (const Direction& d : extension.directions) {
    const std::vector<double> at = boundaryWeights(lights, boundary, d.phiRadians());
    const double share = (d.thetaRadians() - edge) / (pi - edge);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      extension.matrix.push_back((1 - share) * at[i] + share * mean[i]);
    }
  }
  return extension;
}

}  // namespace illum
