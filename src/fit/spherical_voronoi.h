// Voronoi cells on the sphere, one at a time.
#pragma once

#include <span>
#include <vector>

#include "illum/vector.h"

namespace illum {

/// The part of the sphere that is nearer to one site than to all others: a convex spherical
/// polygon, or a lune, a hemisphere or the whole sphere where there are few others.
class SphericalVoronoiCell {
 public:
  /// `others` differ from `site`. O(n log n).
  SphericalVoronoiCell(Direction site, std::span<const Direction> others);

  double area() const;
  /// Of the part with z >= height; -1 < height < 1.
  double areaAbove(double height) const;

 private:
  // The boundary with one neighbour: on the great circle that bisects the two, in the plane through
  // `start` and `ahead` (orthonormal), from parameter `from` to `to`; the cell lies to the left.
  struct Edge {
    Vector3 inward;  ///< unit normal of the bisecting plane, toward the site
    Vector3 start, ahead;
    double from, to;
    double sectorArea;  ///< between the site and the edge
  };

  /// Length in radians of phi of the circle z = height within the cell.
  double circleInside(double height) const;

  std::vector<Edge> edges_;
};

}  // namespace illum
