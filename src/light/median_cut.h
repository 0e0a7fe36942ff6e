// An environment as a number of directional lights.
#pragma once

#include <vector>

#include "illum/environment.h"

namespace illum {

/// P. Debevec, "A Median Cut Algorithm for Light Probe Sampling", 2005: the map is halved `regions`
/// - 1 times, each time the region of most light, across its longer side, into halves of equal
/// light; each region becomes a light at its centroid with all of its colour. Together they have
/// exactly the map's light. Fewer where light comes from fewer texels.
std::vector<DirectionalLight> medianCut(const Environment& environment, int regions);

}  // namespace illum
