// The tree over all triangles and hairs, and rays through it. The only place that knows Embree.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/float3.h"
#include "scene/scene.h"

namespace illum {

/// What a ray met first.
struct Hit {
  std::uint32_t geometry = 0;   ///< meshes first, then sets of curves, in the scene's order
  std::uint32_t primitive = 0;  ///< triangle, or segment of the set of curves
  float u = 0, v = 0;           ///< barycentric; on a curve: u along the segment
  float distance = 0;
  Float3 normal;  ///< geometric, not of unit length
};

/// A shadow ray to a light at infinity. `start` is how far from the origin it begins.
struct ShadowRay {
  float originX, originY, originZ, start;
  float directionX, directionY, directionZ, time = 0;
  float end;  ///< negative once it is known to be blocked
  std::uint32_t mask = ~0u, id = 0, flags = 0;
};

/// Light that is left after glass, as the negated logarithm to the base 2 in units of 2^-20:
/// whole numbers add up to the same sum in any order.
using OpticalDepth = std::array<std::int32_t, 3>;
LinearRgb transmittance(const OpticalDepth& depth);

/// The first control point of every segment, in the order of Hit::primitive.
std::vector<std::uint32_t> segmentsOf(const CurveSet& curves);

/// Decides about surfaces that are not simply opaque.
class SurfaceFilter {
 public:
  virtual ~SurfaceFilter() = default;
  /// Whether a triangle is a hole at this point (alpha cut-outs).
  virtual bool isHole(std::uint32_t geometry, std::uint32_t triangle, float u, float v) const = 0;
  /// What a shadow ray loses in glass; empty: it is blocked.
  virtual std::optional<OpticalDepth> lossThrough(std::uint32_t geometry, std::uint32_t triangle,
                                                  float u, float v, float cosine) const = 0;
};

/// Thread safe once built.
class RayTree {
 public:
  /// Which of a scene's meshes need `filter` to be asked.
  struct Filtered {
    std::vector<bool> holes, glass;  ///< one for each mesh
  };

  /// `scene` and `filter` must outlive the tree. Indices are valid and positions finite.
  RayTree(const Scene& scene, const SurfaceFilter& filter, const Filtered& filtered);
  virtual ~RayTree();
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;

  std::optional<Hit> nearest(Float3 origin, Float3 direction, float start) const;

  /// Traces shadow rays, each on its own account: what becomes of one does not depend on the
  /// others. `depths`, by ShadowRay::id, are added to; they may be empty where the scene has no
  /// glass. (Virtual so that benchmarks can record the rays.)
  virtual void shadows(std::span<ShadowRay> rays, std::span<OpticalDepth> depths) const;

  bool hasGlass() const { return hasGlass_; }
  std::uint64_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  bool hasGlass_ = false;
};

}  // namespace illum
