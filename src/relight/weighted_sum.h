// The heart of relighting: what a light set makes of a tile's codes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "illum/basis_table.h"
#include "illum/light.h"
#include "object/manifest.h"
#include "relight/sum_kernels.h"
#include "relight/tile_planes.h"

namespace illum {

/// One light, or a whole set in a linear object, folded into a few numbers per stored plane:
///   colour(x) = constant + sum_p weight_p * v_p(x),
/// where v_p is the code itself (curve linear; step and offset are inside the weights) or the
/// plane's value (the other curves). Planes of weight 0 are left out.
///
/// Where all weights of the planes k, k + 3, k + 6, … are multiples of one colour, as for separable
/// bases under lights of one colour, and for the exact basis always, the multiples are kept, and
/// colours are made of three sums:
///   colour(x) = constant + sum_c colour_c * (sum_p multiple_p * v_p(x)).
struct FoldedWeights {
  std::array<float, 3> constant{};
  std::vector<WeightedPlane<3>> planes;                    ///< unless it is separable
  std::array<std::vector<WeightedPlane<1>>, 3> separable;  ///< else
  std::array<std::array<float, 3>, 3> colours{};           ///< of the three sums
  bool isSeparable = false;
};

/// Folds m + sum_k b_k P_k. `basisValues`: as LightBasis::evaluate gives them, of one light or
/// summed over a set.
FoldedWeights foldWeights(std::span<const double> basisValues, const CodingEntry& coding);
/// The same for a light of intensity 1 from `toLight`.
FoldedWeights foldWeights(const LightBasis& basis, const CodingEntry& coding, Direction toLight);

/// rgb[3 * i + c] for the texels first … first + rgb.size() / 3 - 1 of the tile. Allocates nothing.
void weightedSum(const TilePlanes& planes, const CodingEntry& coding, const FoldedWeights& weights,
                 std::size_t first, std::span<float> rgb);

/// The object's response g, in place: from what the planes hold to linear light.
void applyResponse(Response response, std::span<float> samples);

}  // namespace illum
