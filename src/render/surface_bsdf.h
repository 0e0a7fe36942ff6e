// The metallic-roughness material: microfacets over a matt base.
#pragma once

#include <array>
#include <optional>

#include "illum/colour.h"
#include "render/direction_batch.h"
#include "render/ggx_albedo.h"
#include "render/surface_point.h"

namespace illum {

struct BsdfSample {
  Float3 direction;
  LinearRgb weight;   ///< value times cosine over density
  float density = 0;  ///< per solid angle
};

/// All that the value depends on beside the light's direction.
struct SurfaceLobes {
  Float3 geometricNormal, normal, toViewer;
  float viewerCosine = 1;
  float alphaSquared = 1;
  float viewerShadowing = 1;  ///< sqrt(alpha^2 + (1 - alpha^2) cosine^2) of the viewer
  LinearRgb facing;           ///< reflectance of a microfacet seen head on
  float grazing = 1;          ///< and seen along it
  LinearRgb matt;             ///< of the base, all but the factor of the light's angle
  AlbedoCurve passes;         ///< what gets through the microfacets, by the light's cosine
  float glossyShare = 1;      ///< of samples drawn from the microfacets
};

/// f = D V F + matt(viewer, light). The microfacets are GGX (Walter, Marschner, Li, Torrance 2007)
/// with height-correlated shadowing (Heitz 2014) and Schlick's Fresnel term. The base gets what
/// they let through, on both ways, so that all together reflect at most what arrives and light may
/// go either way (Kelemen and Szirmay-Kalos 2001, equation 6).
class SurfaceBsdf {
 public:
  SurfaceBsdf(const SurfacePoint& point, Float3 toViewer);

  /// The first `count` of the batch. 0 below either normal's horizon.
  void evaluate(const DirectionBatch& toLight, std::size_t count, BsdfBatch& out) const;

  /// `choice` and `uniform` in [0, 1). Empty: absorbed.
  std::optional<BsdfSample> sample(float choice, std::array<float, 2> uniform) const;

  /// Whether highlights are so narrow that drawing directions finds lights that drawing from the
  /// lights' discs finds badly.
  bool isGlossy() const;

 private:
  SurfaceLobes lobes_;
  float alpha_;
};

}  // namespace illum
