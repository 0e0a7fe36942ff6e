#include <cmath>
#include <memory>
#include <numbers>

#include "illum/transform.h"
#include "scene/bust.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

/// Turned to its left and bent forward a little, about the middle of the neck.
RigidTransform headFromBust() {
  const Vector3 pivot{0, -1.0, -0.25};
  RigidTransform turned = rotationAbout(Direction::fromVector({0, 1, 0}), 0.22) *
                          rotationAbout(Direction::fromVector({1, 0, 0}), 0.07);
  turned.translation = pivot - turned.vector(pivot);
  return inverse(turned);
}

}  // namespace

double torsoDistance(Vector3 p) {
  const Vector3 q{std::abs(p.x), p.y, p.z};
  double d = ellipsoidDistance(q, {0, -2.05, -0.40}, {1.08, 0.85, 0.55});
  d = smoothUnion(d, rodDistance(q, {0.15, -1.32, -0.46}, {1.0, -1.73, -0.44}, 0.20, 0.33), 0.25);
  d = smoothUnion(d, rodDistance(q, {0, -0.80, -0.28}, {0, -1.50, -0.42}, 0.40, 0.48), 0.15);
  d = smoothUnion(d, ellipsoidDistance(q, {0, -1.92, 0.0}, {0.72, 0.42, 0.24}), 0.25);
  d = smoothUnion(d, rodDistance(q, {0.08, -1.50, 0.03}, {0.80, -1.46, -0.30}, 0.05, 0.05), 0.10);
  d = smoothUnion(d, rodDistance(q, {0.40, -0.42, -0.26}, {0.07, -1.47, 0.02}, 0.08, 0.05), 0.10);
  return smoothIntersection(d, ellipsoidDistance(p, {0, -1.35, -0.35}, {1.30, 1.15, 1.0}), 0.05);
}

std::vector<Strand> clothFolds() {
  constexpr int kFolds = 7, kSteps = 28;
  std::vector<Strand> folds;
  for (int f = 0; f < kFolds; ++f) {
    const double share = f / (kFolds - 1.0);
    Strand fold;
    fold.outward = {0, 0.3, 1};
    for (int i = 0; i <= kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps;
      // From the left shoulder (+x) across the chest to below the right arm, hanging through.
      const double x = 0.95 - 1.95 * t - 0.25 * share * (1 - t);
      const double hang = std::sin(std::numbers::pi * t) * (0.22 + 0.30 * share);
      const double y = -1.38 - 0.42 * t - hang - 0.16 * share + 0.03 * std::sin(7 * t + 2 * f);
      // Onto the chest: as far forward as it reaches there.
      double z = 0.9;
      for (int k = 0; k < 40; ++k) z -= 0.7 * torsoDistance({x, y, z});
      fold.points.push_back({x, y, std::max(z, -0.6)});
      fold.radii.push_back(0.064 + 0.014 * std::sin(2 * std::numbers::pi * t + 2 * f));
    }
    folds.push_back(fold);
  }
  return folds;
}

double socleDistance(Vector3 p) {
  // A turned foot: neck, hollow and plinth by its profile.
  const double y = p.y + 2.4;  // 0 where it meets the bust, falling
  const double hollow = 0.30 + 0.32 * std::pow(std::clamp(-y / 0.42, 0.0, 1.0), 2.2);
  const double radius = y < -0.42 ? 0.66 : hollow;
  const double round = std::hypot(p.x, p.z + 0.30);
  const double side = 0.6 * (round - radius);
  const double slab = std::max(y - 0.15, -0.62 - y);
  const double stem = smoothIntersection(side, slab, 0.03);
  const double ring = lengthOf({std::hypot(p.x, p.z + 0.30) - 0.36, y + 0.06, 0}) - 0.055;
  return smoothUnion(stem, ring, 0.02);
}

std::function<double(Vector3)> bustDistance() {
  const auto hair = std::make_shared<RodCloud>(hairLocks(), 0.016, 0.1);
  const auto folds = std::make_shared<RodCloud>(clothFolds(), 0.05, 0.15);
  return [hair, folds, toHead = headFromBust()](Vector3 p) {
    const Vector3 inHead = toHead.point(p);
    // Balls around head and body: far from one of them it need not be looked at.
    double head = sphereDistance(inHead, {0, -0.2, -0.1}, 1.4);
    if (head < 0.2) head = headDistance(inHead);
    if (head < 0.4) head = smoothUnion(head, hair->distance(inHead), 0.02);
    double body = sphereDistance(p, {0, -1.85, -0.35}, 1.55);
    if (body < 0.2) body = torsoDistance(p);
    if (body < 0.4) body = smoothUnion(body, folds->distance(p), 0.09);
    return smoothUnion(smoothUnion(head, body, 0.08), socleDistance(p), 0.03);
  };
}

}  // namespace illum
