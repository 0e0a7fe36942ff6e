// One path through the scene, lit by all lights at every corner.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/camera_rays.h"
#include "render/light_table.h"
#include "render/ray_tree.h"
#include "render/sample_sequence.h"
#include "render/surface_point.h"

namespace illum {

/// Radiance under each light, colour by colour.
struct LightSums {
  explicit LightSums(std::size_t lights) {
    for (auto& channel : channels) channel.resize(lights);
  }
  void clear() {
    for (auto& channel : channels) std::fill(channel.begin(), channel.end(), 0.0f);
  }
  void scale(float factor) {
    for (auto& channel : channels) {
      for (float& sum : channel) sum *= factor;
    }
  }
  void add(std::size_t light, LinearRgb value) {
    channels[0][light] += value.r;
    channels[1][light] += value.g;
    channels[2][light] += value.b;
  }
  std::array<std::vector<float>, 3> channels;
};

/// Not thread safe: it has buffers. Cheap to make.
class PathTracer {
 public:
  PathTracer(const RayTree& tree, const SceneSurfaces& surfaces, const LightTable& lights,
             int bounces)
      : tree_(tree), surfaces_(surfaces), lights_(lights), bounces_(bounces) {}

  /// Adds what arrives along the beam. False: it meets nothing, and nothing is added.
  bool trace(const BeamRay& beam, const SampleSequence& sequence, LightSums& sums);

 private:
  struct Path;
  bool ideal(const SurfacePoint& point, Path& path) const;
  template <typename Bsdf>
  bool scatter(const SurfacePoint& point, const Bsdf& bsdf, Path& path, LightSums& sums);
  template <typename Bsdf>
  void addLights(const SurfacePoint& point, const Bsdf& bsdf, const Path& path, bool alsoDrawn,
                 LightSums& sums);
  std::size_t aimAt(const SurfacePoint& point, const DirectionBatch& directions, std::size_t count);
  void addDiscs(const Path& path, LightSums& sums) const;

  const RayTree& tree_;
  const SceneSurfaces& surfaces_;
  const LightTable& lights_;
  const int bounces_;

  // Of one batch of lights.
  DirectionBatch directions_;
  BsdfBatch values_;
  std::array<ShadowRay, kBatch> rays_;
  std::array<float, kBatch> shares_;  // of the light strategy, by light
  std::array<OpticalDepth, kBatch> depths_{};
};

}  // namespace illum
