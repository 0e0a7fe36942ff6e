// Light on hair.
#pragma once

#include <array>
#include <optional>

#include "render/direction_batch.h"
#include "render/surface_bsdf.h"

namespace illum {

/// A fibre's scattering function after Kajiya and Kay 1989, with energy kept within bounds: the
/// radiance toward the viewer is the integral of S * radiance * sin(tangent, light), and
///     S = (1 - gloss) colour (2 / pi) p(phi) + gloss m(theta) cos(phi / 2) / 4.
/// p spreads light about the fibre as a matt cylinder does, a part of it forward (after Goldman
/// 1997); m is a von Mises lobe about the cone of mirror directions. S is the same both ways.
class HairBsdf {
 public:
  HairBsdf(const SurfacePoint& point, Float3 toViewer);

  void evaluate(const DirectionBatch& toLight, std::size_t count, BsdfBatch& out) const;
  std::optional<BsdfSample> sample(float choice, std::array<float, 2> uniform) const;
  bool isGlossy() const { return false; }  ///< its lobes are wide

 private:
  Float3 tangent_, toViewer_;
  float viewerAlong_, viewerAcross_;  // cosine and sine of the angle between tangent and viewer
  LinearRgb matt_;
  float gloss_;
  float concentration_, lobe_;  // of m, and its height
};

}  // namespace illum
