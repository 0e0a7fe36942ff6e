// The paper's extension across the equator (section 5, figure 11) as a linear step on the samples.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "illum/vector.h"

namespace illum {

/// Virtual lights: sample under directions[m] = sum over lights i of matrix[m * lights + i] *
/// sample i. Every row sums to 1, so that constants stay constant.
struct Extension {
  std::vector<Direction> directions;
  std::vector<double> matrix;  ///< row-major, directions.size() x lights
  int lights = 0;

  std::span<const double> row(std::size_t m) const {
    return {matrix.data() + m * static_cast<std::size_t>(lights), static_cast<std::size_t>(lights)};
  }
};

/// Virtual samples on the rest of the sphere. The value on the boundary of the lit cap is
/// interpolated in azimuth from the boundary lights (those that no light lies further out than, in
/// their own sector of azimuth); from there it goes linearly in theta to the boundary's mean at the
/// south pole. `spacing` between virtual lights in radians; 0: the lights' own mean distance to the
/// nearest neighbour, but at most 500 virtual lights. Empty if the lights cover the whole sphere
/// (litCapOf). At least one light.
Extension extendBelowHorizon(std::span<const Direction> lights, double spacingRadians = 0);

}  // namespace illum
