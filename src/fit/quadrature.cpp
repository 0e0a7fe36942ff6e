#include "fit/quadrature.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace illum {
namespace {

using std::numbers::pi;

// P_n(x) and its derivative by the three-term recurrence; |x| < 1.
std::pair<double, double> legendre(int n, double x) {
  double below = 1, p = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * p - (k - 1) * below) / k;
    below = p;
    p = next;
  }
  return {p, n * (x * p - below) / (x * x - 1)};
}

}  // namespace

// Newton's iteration from Tricomi's first guess; see W. Gautschi, "Orthogonal Polynomials", 2004.
std::vector<std::pair<double, double>> gaussLegendre(int count) {
  assert(count >= 1);
  if (count == 1) return {{0, 2}};
  std::vector<std::pair<double, double>> rule(count);
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (count + 0.5));
    for (int iteration = 0; iteration < 10; ++iteration) {
      const auto [p, slope] = legendre(count, x);
      const double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    const double slope = legendre(count, x).second;
    rule[i] = {x, 2 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

std::vector<WeightedDirection> capQuadrature(double thetaMaxRadians, int rings) {
  const double lowest = std::cos(thetaMaxRadians), half = (1 - lowest) / 2;
  const int steps = 2 * rings;
  std::vector<WeightedDirection> nodes;
  nodes.reserve(static_cast<std::size_t>(rings) * steps);
  for (const auto& [x, weight] : gaussLegendre(rings)) {
    const double theta = std::acos(lowest + half * (x + 1));
    for (int s = 0; s < steps; ++s) {
      const double phi = 2 * pi * (s + 0.5) / steps;
      nodes.push_back({Direction::fromAngles(theta, phi), weight * half * 2 * pi / steps});
    }
  }
  return nodes;
}

}  // namespace illum
