#include "scene/scene.h"

#include <algorithm>
#include <limits>

namespace illum {
namespace {

void include(Bounds& bounds, const std::array<double, 3>& p, double radius) {
  bounds.low = {std::min(bounds.low.x, p[0] - radius), std::min(bounds.low.y, p[1] - radius),
                std::min(bounds.low.z, p[2] - radius)};
  bounds.high = {std::max(bounds.high.x, p[0] + radius), std::max(bounds.high.y, p[1] + radius),
                 std::max(bounds.high.z, p[2] + radius)};
}

}  // namespace

Bounds boundsOf(const Scene& scene) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const TriangleMesh& mesh : scene.meshes) {
    for (const auto& p : mesh.positions) include(bounds, {p[0], p[1], p[2]}, 0);
  }
  for (const CurveSet& set : scene.curves) {
    for (const auto& p : set.points) include(bounds, {p[0], p[1], p[2]}, p[3]);
  }
  return bounds;
}

}  // namespace illum
