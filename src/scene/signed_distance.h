// Shapes as signed distances (negative inside) and ways to join them, for sculpted built-in scenes.
// After I. Quilez, "Distance functions" and "Smooth minimum" (2008-2013). Distances are exact for
// spheres, bounds near the truth for the rest.
#pragma once

#include <algorithm>
#include <cmath>

#include "illum/vector.h"

namespace illum {

inline double lengthOf(Vector3 v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

inline double sphereDistance(Vector3 p, Vector3 centre, double radius) {
  return lengthOf(p - centre) - radius;
}

/// First-order: exact in direction of the axes, near the surface good everywhere.
inline double ellipsoidDistance(Vector3 p, Vector3 centre, Vector3 radii) {
  const Vector3 q = p - centre;
  const Vector3 scaled{q.x / radii.x, q.y / radii.y, q.z / radii.z};
  const double k0 = lengthOf(scaled);
  const double k1 = lengthOf({scaled.x / radii.x, scaled.y / radii.y, scaled.z / radii.z});
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

/// Where the foot of the perpendicular from p on the segment lies: 0 at a, 1 at b.
inline double alongSegment(Vector3 p, Vector3 a, Vector3 b) {
  const Vector3 ap = p - a, ab = b - a;
  const double squared = ab.x * ab.x + ab.y * ab.y + ab.z * ab.z;
  return std::clamp((ap.x * ab.x + ap.y * ab.y + ap.z * ab.z) / squared, 0.0, 1.0);
}

/// A rod with round ends whose radius goes from `radiusA` to `radiusB`; a != b.
inline double rodDistance(Vector3 p, Vector3 a, Vector3 b, double radiusA, double radiusB) {
  const double t = alongSegment(p, a, b);
  return lengthOf(p - (a + t * (b - a))) - (radiusA + t * (radiusB - radiusA));
}

/// The union of two shapes, their seam filled over a width of `k` > 0.
inline double smoothUnion(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * h * h * k;
}
inline double smoothIntersection(double a, double b, double k) {
  return -smoothUnion(-a, -b, k);
}
/// `a` without `b`, the rim rounded over a width of `k` > 0.
inline double smoothDifference(double a, double b, double k) {
  return smoothIntersection(a, -b, k);
}

}  // namespace illum
