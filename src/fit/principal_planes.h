// Which few planes carry the pictures under all lights best.
#pragma once

#include <span>
#include <vector>

#include "fit/kriging.h"

namespace illum {

/// The picture under a light from w is mean(w) + sum_k b_k(w) P_k with mean_c(w) = weights(w) .
/// mean_c, b_kc(w) = weights(w) . functions(c, k) and P = analysis * (samples - mean); rows of
/// `functions` and columns of `analysis` by channel (c * lights + l). Planes are uncorrelated, of
/// falling variance.
struct PrincipalPlanes {
  Matrix functions;  ///< 3 lights x planes
  Matrix analysis;   ///< planes x 3 lights
  Vector variances;
};

/// Principal components of the *interpolated* picture w -> picture(w): optimal for lights of which
/// half are drawn from the photographs' own and half from all over the lit domain. `count` is cut
/// to what there is.
PrincipalPlanes principalPlanes(const Kriging& kriging, std::span<const Direction> lights,
                                const ChannelMoments& moments, int count);

/// How many planes: multiples of 3 up to kGreatestDefaultPlanes are tried in five-fold
/// cross-validation, everything fitted anew but the kriging model, and the fewest within
/// kPlaneToleranceDecibels of the best are taken. The order of the lights does not matter. All
/// there are (up to the limit) for less than ten lights.
int choosePlaneCount(std::span<const Direction> lights, const ChannelMoments& moments,
                     const KrigingModel& model);
inline constexpr double kPlaneToleranceDecibels = 0.02;
inline constexpr int kGreatestDefaultPlanes = 45;

}  // namespace illum
