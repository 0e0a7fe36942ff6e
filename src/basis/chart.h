// The chart of directions: which samples interpolation can reach, and what is below the horizon
// (docs/format.md, "basis.bin").
#pragma once

#include "illum/basis_table.h"

#include <cstdint>
#include <vector>

namespace illum {

/// One flag per sample of a (N+2)^2 square with guard ring, row-major: 1 if the sample is in the 4
/// x 4 stencil of a cell that touches the disc, whole or in a point. In integers, so that writers
/// and readers agree: with doubled coordinates the disc has centre and radius N-1, cell (i, j)
/// spans [2i, 2i+2] x [2j, 2j+2] for 0 <= i, j < N-1, and its stencil is samples i … i+3 by j …
/// j+3.
std::vector<std::uint8_t> reachableSamples(int resolution);

/// How a table of the hemisphere is continued below the horizon (figure 11 of Wong et al. 1997):
/// from the equator's value under the same azimuth, linearly in theta, to a constant at the south
/// pole.
struct BelowHorizon {
  ChartPoint equator;
  double southPole = 0;  ///< the constant's share, in [0, 1]; the equator has the rest
};
/// Of a direction with z < 0.
BelowHorizon belowHorizon(Direction d);

}  // namespace illum
