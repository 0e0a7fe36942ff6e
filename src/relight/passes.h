// How a set of lights goes over the planes: once where the response lets lights be added up before,
// else once a light.
#pragma once

#include <span>
#include <vector>

#include "basis/light_sum.h"
#include "illum/lighting.h"
#include "relight/weighted_sum.h"

namespace illum {

/// One set of weights, and what is applied behind the response.
struct Pass {
  FoldedWeights weights;
  LinearRgb intensity{1, 1, 1};
};

/// What lights at infinity come down to for one basis and coding.
class Passes {
 public:
  Passes() = default;
  /// Linear responses: everything in one pass. Others: one for each light, and no environments,
  /// which have to be reduced to lights before (reduceEnvironment).
  Passes(const LightBasis& basis, const CodingEntry& coding, Response response,
         std::span<const DirectionalLight> lights, std::span<const Environment> environments = {});

  /// How often the planes are gone through.
  int count() const { return static_cast<int>(passes_.size()); }

  /// Linear RGB of rgb.size() / 3 texels of a tile from `first` on. `scratch` is used again from
  /// call to call.
  void relight(const TilePlanes& codes, std::size_t first, std::span<float> rgb,
               std::vector<float>& scratch) const;

 private:
  CodingEntry coding_;
  Response response_ = Response::Linear;
  std::vector<Pass> passes_;
};

/// Adds up a whole environment; the same on any number of threads.
void addEnvironment(LightSum& sum, const Environment& environment);

}  // namespace illum
