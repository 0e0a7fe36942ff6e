// Interpolation between a table's samples along one axis of the chart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace illum {

/// Weights of the four samples around a cell at t in [0, 1] between the middle two: Catmull and Rom
/// 1974 with tension 1/2, written so that t = 0 and t = 1 give exact zeros and ones.
inline std::array<double, 4> catmullRom(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t + 2 * t2 - t3), 0.5 * (2 - 5 * t2 + 3 * t3), 0.5 * (t + 4 * t2 - 3 * t3),
          0.5 * (-t2 + t3)};
}

/// The cell of an axis that a chart coordinate lies in, and the weights of its four samples there.
struct CellCoordinate {
  int cell;
  std::array<double, 4> weights;
};

inline CellCoordinate cellCoordinate(double chart, int resolution) {
  const double u = chart * (resolution - 1);
  const int cell = std::clamp(static_cast<int>(std::floor(u)), 0, resolution - 2);
  return {cell, catmullRom(u - cell)};
}

}  // namespace illum
