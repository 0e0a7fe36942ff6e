// Many tapered rods as one signed distance: locks of hair, folds of cloth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "illum/vector.h"
#include "scene/scene.h"

namespace illum {

/// A chain of rods along `points`, at least two different ones in a row.
struct Strand {
  std::vector<Vector3> points;
  std::vector<double> radii;  ///< as many
  Vector3 outward;            ///< the side on which grooves begin; not along the strand
  double grooves = 0;         ///< their depth
  int grooveCount = 8;        ///< around the strand
};

class RodCloud {
 public:
  /// Strands sink into each other over a width of `blend`. Distances beyond `reach` are only said
  /// to be at least that.
  RodCloud(std::span<const Strand> strands, double blend, double reach);

  double distance(Vector3 p) const;

 private:
  struct Rod {
    Vector3 a, b;
    double radiusA, radiusB;
    Vector3 side, up;  // across the rod, for its grooves
    double grooves;
    int grooveCount;
    std::uint32_t strand;
  };
  static double distance(const Rod& rod, Vector3 p);
  void addTo(std::uint32_t index);
  std::size_t cellOf(int x, int y, int z) const;

  double blend_, reach_, cell_;
  std::vector<Rod> rods_;
  Bounds bounds_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<std::vector<std::uint32_t>> cells_;  // which rods come near them
};

}  // namespace illum
