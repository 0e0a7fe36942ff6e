// The paper's extension across the equator (section 5, figure 11) as a linear step on the samples.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "illum/vector.h"

namespace illum {

/// Virtual lights: sample under directions[m] = sum over lights i of matrix[m * lights + i] *
/// sample i. Every row sums to 1, so that constants stay constant; no entry is negative.
struct Extension {
  std::vector<Direction> directions;
  std::vector<double> matrix;  ///< row-major, directions.size() x lights
  int lights = 0;

  std::span<const double> row(std::size_t m) const {
    return {matrix.data() + m * static_cast<std::size_t>(lights), static_cast<std::size_t>(lights)};
  }
};

/// The lights that bound the lit part of the sky, ordered by azimuth: light i is one if no light
/// has a larger theta within the lights' mean spacing of it, measured in azimuth along i's own
/// circle of latitude. Of lights in the same direction the first one stands for all.
std::vector<std::size_t> boundaryLights(std::span<const Direction> lights);

/// The boundary's value at an azimuth as weights of the lights, which sum to 1: linear in phi
/// between neighbouring boundary lights.
std::vector<double> boundaryWeights(std::span<const Direction> lights,
                                    std::span<const std::size_t> boundary, double phiRadians);

/// Virtual samples on the part of the sphere below the horizon, or below the lit cap (litCapOf)
/// where that reaches lower: at the upper edge the boundary's value under the same azimuth, going
/// linearly in theta to the boundary's mean over all azimuths at the south pole. The virtual lights
/// form a Fibonacci lattice of about `spacingRadians`; 0: the real lights' own mean spacing. At
/// least 8 and at most 500 of them; none if the lights cover the whole sphere. At least one light.
Extension extendBelowHorizon(std::span<const Direction> lights, double spacingRadians = 0);

}  // namespace illum
