// Lights near the object: every pixel has a direction of its own to each of them.
#pragma once

#include <span>
#include <vector>

#include "illum/lighting.h"
#include "relight/weighted_sum.h"

namespace illum {

/// The lights beside a group of views, in its frame.
class NearLights {
 public:
  NearLights() = default;
  /// Keeps a reference to `basis`.
  NearLights(const LightBasis& basis, const CodingEntry& coding, Response response,
             std::vector<NearLight> lights);

  bool empty() const { return lights_.empty(); }

  /// Adds what the lights give to texels first, first + 1, ... of a tile, which lie at `points` of
  /// the group's frame, to their linear RGB. `scratch` is memory that is used again.
  void addTo(std::span<float> rgb, const TilePlanes& codes, std::size_t first,
             std::span<const Vector3> points, std::vector<float>& scratch) const;

 private:
  void planeValues(const TilePlanes& codes, std::size_t texel, std::span<float> values) const;

  const LightBasis* basis_ = nullptr;
  CodingEntry coding_;
  Response response_ = Response::Linear;
  std::vector<NearLight> lights_;
};

}  // namespace illum
