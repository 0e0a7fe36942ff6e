#include "scene/fur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/hair_file.h"
#include "scene/random_numbers.h"
#include "scene/shapes.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

Vector3 unit(Vector3 v) {
  return (1 / lengthOf(v)) * v;
}

/// Within about one percent (K. Thomsen, 2004).
double areaOf(const Vector3& r) {
  constexpr double kPower = 1.6075;
  const auto product = [&](double a, double b) { return std::pow(a * b, kPower); };
  const double mean = (product(r.x, r.y) + product(r.x, r.z) + product(r.y, r.z)) / 3;
  return 4 * kPi * std::pow(mean, 1 / kPower);
}

struct Root {
  Vector3 position, normal;
};

/// A smooth vector field of no preferred direction: hairs of a tuft lean the same way.
Vector3 tuft(Vector3 p) {
  return {std::sin(17 * p.y + 5 * std::sin(7 * p.z)) + 0.6 * std::sin(41 * p.z + 9 * p.x),
          std::sin(15 * p.z + 5 * std::sin(8 * p.x)) + 0.6 * std::sin(43 * p.x + 8 * p.y),
          std::sin(16 * p.x + 5 * std::sin(9 * p.y)) + 0.6 * std::sin(39 * p.y + 7 * p.z)};
}

class Groomer {
 public:
  Groomer(std::span<const FurryPart> parts, std::span<const FurryPart> bald, std::uint64_t seed)
      : parts_(parts), bald_(bald), random_(seed) {}

  void grow(std::size_t part, CurveSet& curves) {
    const Root root = rootOn(parts_[part]);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (i != part && distanceFrom(parts_[i], root.position) < 0) return;
    for (const FurryPart& patch : bald_)
      if (distanceFrom(patch, root.position) < kBaldMargin) return;
    addHairAt(root, parts_[part], curves);
  }

 private:
  Vector3 onSphere() {
    const double z = random_.uniform(-1, 1), phi = random_.uniform(0, 2 * kPi);
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(phi), across * std::sin(phi), z};
  }

  /// Even over the ellipsoid: a point of the sphere is taken as often as its surroundings grow.
  Root rootOn(const FurryPart& part) {
    const Vector3& r = part.radii;
    const double least = std::min({r.x, r.y, r.z});
    for (;;) {
      const Vector3 s = onSphere();
      const Vector3 steep{s.x / r.x, s.y / r.y, s.z / r.z};
      if (random_.uniform(0, 1) > least * lengthOf(steep)) continue;
      return {part.objectFromPart.point({r.x * s.x, r.y * s.y, r.z * s.z}),
              part.objectFromPart.vector(unit(steep))};
    }
  }

  void addHairAt(const Root& root, const FurryPart& part, CurveSet& curves) {
    constexpr int kPoints = 5;
    constexpr double kSunk = 0.1;  // of the length, so that roots are never seen
    const Vector3 noise = onSphere();
    Vector3 way =
        unit(root.normal + 0.22 * noise + 0.30 * tuft(root.position) + Vector3{0, -0.35, 0});
    if (dot(way, root.normal) < 0.35) way = unit(way + (0.6 - dot(way, root.normal)) * root.normal);
    const double length = part.hairLength * random_.uniform(0.65, 1.15);
    const double step = length * (1 + kSunk) / (kPoints - 1);
    std::array<Vector3, kPoints> points;
    points[0] = root.position - kSunk * length * way;
    for (std::size_t i = 1; i < kPoints; ++i) {
      points[i] = points[i - 1] + step * way;
      way = unit(way + Vector3{0, -0.22, 0} + 0.12 * noise);
    }
    addHair(curves, points, {kRootRadius, kTipRadius});
    const auto shade = static_cast<float>(random_.uniform(0.7, 1.15));
    const auto channel = [&](float c) { return std::min(1.0f, shade * c); };
    curves.colours.push_back(
        {channel(part.colour.r), channel(part.colour.g), channel(part.colour.b)});
  }

  static constexpr double kBaldMargin = 0.028;
  static constexpr double kRootRadius = 0.0042, kTipRadius = 0.0012;

  std::span<const FurryPart> parts_, bald_;
  RandomNumbers random_;
};

}  // namespace

TriangleMesh skinMesh(const FurryPart& part, int steps) {
  TriangleMesh mesh = sphereMesh(steps);
  const Vector3& r = part.radii;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vector3 s = vectorOf(mesh.positions[i]);
    mesh.positions[i] = floatsOf({r.x * s.x, r.y * s.y, r.z * s.z});
    mesh.normals[i] = floatsOf(unit({s.x / r.x, s.y / r.y, s.z / r.z}));
  }
  transform(mesh, part.objectFromPart);
  return mesh;
}

double distanceFrom(const FurryPart& part, Vector3 point) {
  return ellipsoidDistance(inverse(part.objectFromPart).point(point), {0, 0, 0}, part.radii);
}

CurveSet furOn(std::span<const FurryPart> parts, std::span<const FurryPart> bald, int count,
               std::uint64_t seed) {
  double area = 0;
  for (const FurryPart& part : parts) area += areaOf(part.radii);
  CurveSet curves;
  curves.name = "fur";
  Groomer groomer(parts, bald, seed);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto here = std::lround(count * areaOf(parts[i].radii) / area);
    for (long k = 0; k < here; ++k) groomer.grow(i, curves);
  }
  return curves;
}

}  // namespace illum
