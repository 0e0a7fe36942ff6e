// Environments for objects whose response is not linear, where each direction has to be decoded by
// itself: the fewest directions that do.
#pragma once

#include <vector>

#include "codec/tile.h"
#include "illum/environment.h"
#include "relight/weighted_sum.h"

namespace illum {

struct ReducedEnvironment {
  std::vector<DirectionalLight> lights;
  double error = 0;  ///< rms over the probe's texels and channels, relative to the picture's rms
};

/// Median cut with as few regions as keep the relative rms error of the probe's picture under
/// `bound`; 0 < bound. The error is measured against kReferenceRegions of the same cut. If
/// kMostDirections do not suffice, they are what is returned, with the error that remains. `probe`:
/// some texels of the object, in the hope that they are like all.
ReducedEnvironment reduceEnvironment(const Environment& environment, const LightBasis& basis,
                                     const CodingEntry& coding, Response response,
                                     const PlaneCodes& probe, double bound);
inline constexpr int kReferenceRegions = 4096, kMostDirections = 1024;

/// Every so manieth texel of a tile, about `texels` of them.
PlaneCodes probeOf(const PlaneCodes& tile, std::size_t texels);

}  // namespace illum
