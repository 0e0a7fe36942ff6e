// The lights of one call: directions in the order that vector instructions want, and an index of
// the discs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/disc_kernel.h"
#include "render/float3.h"
#include "render/renderer.h"

namespace illum {

/// Discs of one angular radius, found by direction. The sphere is cut into the cells of an
/// octahedral map; each knows the discs that reach into it.
class DiscIndex {
 public:
  DiscIndex() = default;
  DiscIndex(std::span<const Float3> centres, double radiusRadians);

  /// Candidates in ascending order: every disc that holds `direction` is among them.
  std::span<const std::uint32_t> near(Float3 direction) const;

 private:
  std::size_t cellOf(Float3 direction) const;

  int side_ = 0;
  std::vector<std::uint32_t> starts_;  // of each cell in `discs_`
  std::vector<std::uint32_t> discs_;
};

/// Lights of irradiance pi on what faces them: discs of even radiance, or mere directions.
class LightTable {
 public:
  LightTable(std::span<const RenderLight> lights, double radiusRadians);

  std::size_t count() const { return count_; }
  bool areDiscs() const { return areDiscs_; }
  /// What a direction drawn on a disc stands for: radiance over density; pi without discs.
  float weight() const { return weight_; }
  float radiance() const { return radiance_; }  ///< of a disc
  float density() const { return density_; }    ///< of directions on a disc, per solid angle

  /// A point on each disc of a batch. All lights share `uniform`, each turned by its own two
  /// numbers, a function of its id.
  /// Points to `buffer`, or to the lights themselves where they are not discs.
  const DirectionBatch& draw(std::size_t batch, std::array<float, 2> uniform,
                             DirectionBatch& buffer) const;

  /// Calls use(l) for every light whose disc holds `direction`.
  template <typename Use>
  void forDiscsAt(Float3 direction, Use use) const {
    for (const std::uint32_t l : index_.near(direction)) {
      const Float3 apart = direction - centres_[l];
      // |a - b|^2 = 4 sin^2(angle / 2), which is accurate for small angles.
      if (dot(apart, apart) <= chordSquared_) use(static_cast<std::size_t>(l));
    }
  }

 private:
  std::size_t count_;
  bool areDiscs_;
  float weight_, radiance_ = 0, density_ = 0;
  float chordSquared_ = 0;
  float height_ = 0;  // of the spherical cap: 1 - cos(radius)
  std::vector<Float3> centres_;
  std::vector<DiscBatch> batches_;
  DiscIndex index_;
};

}  // namespace illum
