#include "scene/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/shapes.h"

namespace illum {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

RigidTransform rigidPartOf(const PlacementRecord& placement) {
  const Vector3& degrees = placement.rotateDegrees;
  RigidTransform rigid = rotationAbout(Direction::fromVector({0, 0, 1}), degrees.z * kDegree) *
                         rotationAbout(Direction::fromVector({0, 1, 0}), degrees.y * kDegree) *
                         rotationAbout(Direction::fromVector({1, 0, 0}), degrees.x * kDegree);
  rigid.translation = placement.translate;
  return rigid;
}

Vector3 scaled(Vector3 v, Vector3 by) {
  return {v.x * by.x, v.y * by.y, v.z * by.z};
}

bool isIdentity(const PlacementRecord& p) {
  return p.scale == Vector3{1, 1, 1} && p.rotateDegrees == Vector3{} && p.translate == Vector3{};
}

}  // namespace

void place(TriangleMesh& mesh, const PlacementRecord& placement) {
  if (isIdentity(placement)) return;
  const RigidTransform rigid = rigidPartOf(placement);
  const Vector3 s = placement.scale, inverseScale{1 / s.x, 1 / s.y, 1 / s.z};
  for (auto& p : mesh.positions) p = floatsOf(rigid.point(scaled(vectorOf(p), s)));
  for (auto& n : mesh.normals) {
    const Vector3 turned = rigid.vector(scaled(vectorOf(n), inverseScale));
    n = floatsOf((1 / length(turned)) * turned);
  }
  if (s.x * s.y * s.z < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
}

void place(CurveSet& curves, const PlacementRecord& placement) {
  const RigidTransform rigid = rigidPartOf(placement);
  const double factor = placement.scale.x;
  for (auto& p : curves.points) {
    const Vector3 moved = rigid.point(factor * Vector3{p[0], p[1], p[2]});
    p = {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(moved.z),
         static_cast<float>(factor * p[3])};
  }
}

void normalise(Scene& scene) {
  const Bounds bounds = boundsOf(scene);
  const Vector3 middle = 0.5 * (bounds.low + bounds.high), sides = bounds.high - bounds.low;
  const double longest = std::max({sides.x, sides.y, sides.z});
  if (!std::isfinite(longest)) return;  // nothing in it
  const double factor = longest > 0 ? 2 / longest : 1;
  for (TriangleMesh& mesh : scene.meshes) {
    for (auto& p : mesh.positions) p = floatsOf(factor * (vectorOf(p) - middle));
  }
  for (CurveSet& set : scene.curves) {
    for (auto& p : set.points) {
      const Vector3 moved = factor * (Vector3{p[0], p[1], p[2]} - middle);
      p = {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(moved.z),
           static_cast<float>(factor * p[3])};
    }
  }
}

}  // namespace illum
