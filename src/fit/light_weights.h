// Solid angles: how much of the lit sky each light stands for.
#pragma once

#include <span>
#include <vector>

#include "fit/quadrature.h"
#include "illum/basis_table.h"
#include "illum/vector.h"

namespace illum {

/// The lit part of the sky: the polar cap theta <= thetaMaxRadians about +z. pi: the whole sphere.
struct LitCap {
  double thetaMaxRadians = 0;

  double solidAngle() const;  ///< steradians
  /// Which chart such lights need: the hemisphere's unless lights lie more than 20 degrees below
  /// the horizon.
  LightDomain domain() const;
};

/// Mean angle between a light and its nearest neighbour in another direction; 0 if there is no
/// other.
double meanSpacingRadians(std::span<const Direction> lights);

/// The cap that the lights cover: up to the largest theta plus half the mean distance of a light to
/// its nearest neighbour; at most the horizon if no light is below it; the whole sphere if what
/// remains around the south pole is no larger than the lights' own spacing. One light alone lights
/// the hemisphere (or the sphere, from below). At least one light.
LitCap litCapOf(std::span<const Direction> lights);

/// weights[i]: area of the spherical Voronoi cell of lights[i] within the cap, in steradians, exact
/// to rounding; their sum is cap.solidAngle(). Lights in the same direction (to 1e-6 radians) share
/// their cell equally. At least one light.
std::vector<double> solidAngleWeights(std::span<const Direction> lights, LitCap cap);

/// capQuadrature over litCapOf(lights), fine enough for every basis in use (48 rings).
std::vector<WeightedDirection> litDomainQuadrature(std::span<const Direction> lights);

}  // namespace illum
