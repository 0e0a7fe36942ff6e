// What a ray finds where it meets the scene.
#pragma once

#include <vector>

#include "render/camera_rays.h"
#include "render/float3.h"
#include "render/ray_tree.h"
#include "render/texture_pyramid.h"
#include "scene/scene.h"

namespace illum {

struct SurfacePoint {
  Float3 position;
  /// Unit normals on the side from which the ray came. What the ray sees is never below the
  /// horizon of either.
  Float3 geometricNormal, shadingNormal;
  bool fromBehind = false;  ///< the ray came from inside
  Float3 tangent;           ///< of hair, unit length
  float clearance = 0;      ///< how far from `position` a new ray is free of rounding errors
  float hairRadius = 0;
  float beamWidth = 0;  ///< of the beam that arrives
  Material::Kind kind = Material::Kind::Surface;
  LinearRgb colour;  ///< in [0, 1]
  float metallic = 0, roughness = 1, specular = 0.5f, ior = 1.5f;

  /// Where a ray begins that leaves on the side of `direction`.
  Float3 startToward(Float3 direction) const {
    const float side = dot(direction, geometricNormal) < 0 ? -clearance : clearance;
    return position + side * geometricNormal;
  }
};

/// A scene's geometry and materials, looked up by what was hit. Thread safe.
class SceneSurfaces final : public SurfaceFilter {
 public:
  /// Throws Error (Fault::Input) where indices lead nowhere or numbers are not finite.
  explicit SceneSurfaces(const Scene& scene);

  SurfacePoint at(const Hit& hit, const BeamRay& beam) const;

  /// Which meshes need to be asked about holes and glass.
  RayTree::Filtered filtered() const;
  bool isHole(std::uint32_t geometry, std::uint32_t triangle, float u, float v) const override;
  std::optional<OpticalDepth> lossThrough(std::uint32_t geometry, std::uint32_t triangle, float u,
                                          float v, float cosine) const override;

  const Scene& scene() const { return scene_; }
  std::uint64_t bytes() const;

 private:
  SurfacePoint onTriangle(const Hit& hit, const BeamRay& beam) const;
  SurfacePoint onCurve(const Hit& hit, const BeamRay& beam) const;

  Scene scene_;  // its textures are empty: the pyramids hold them
  std::vector<TexturePyramid> textures_;
  std::vector<std::vector<std::uint32_t>> segments_;        // of each set of curves
  std::vector<std::vector<std::uint32_t>> curveOfSegment_;  // where curves have colours
};

}  // namespace illum
