// Quadrature rules over directions.
#pragma once

#include <utility>
#include <vector>

#include "illum/vector.h"

namespace illum {

/// One node of a quadrature rule over directions.
struct WeightedDirection {
  Direction direction;
  double weight = 0;  ///< steradians
};

/// Nodes and weights of the Gauss-Legendre rule on [-1, 1], ascending; exact for polynomials up to
/// degree 2 * count - 1. count >= 1.
std::vector<std::pair<double, double>> gaussLegendre(int count);

/// Gauss-Legendre in cos(theta) times equal steps in phi over the polar cap theta <=
/// thetaMaxRadians: exact for spherical harmonics up to degree 2 * rings - 1 and their products of
/// that degree.
std::vector<WeightedDirection> capQuadrature(double thetaMaxRadians, int rings);

}  // namespace illum
