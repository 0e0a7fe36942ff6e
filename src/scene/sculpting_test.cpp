// What sculpted scenes are made with: distances, isosurfaces, rods, fur, heights.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "illum/error.h"
#include "scene/coin.h"
#include "scene/fur.h"
#include "scene/isosurface.h"
#include "scene/rod_cloud.h"
#include "scene/shapes.h"
#include "scene/signed_distance.h"

namespace illum {
namespace {

TEST(SignedDistance, SmoothUnionFillsTheSeamAndNothingElse) {
  EXPECT_DOUBLE_EQ(smoothUnion(1, 2, 0.5), 1) << "far apart";
  EXPECT_DOUBLE_EQ(smoothUnion(2, 1, 0.5), 1);
  EXPECT_DOUBLE_EQ(smoothUnion(1, 1, 0.4), 1 - 0.1)
      << "a quarter of the width where both are equal";
  for (double a = -1; a <= 1; a += 0.1) {
    EXPECT_LE(smoothUnion(a, 0.2, 0.3), std::min(a, 0.2) + 1e-15);
    EXPECT_GE(smoothIntersection(a, 0.2, 0.3), std::max(a, 0.2) - 1e-15);
    EXPECT_GE(smoothDifference(a, 0.2, 0.3), std::max(a, -0.2) - 1e-15);
  }
}

TEST(SignedDistance, EllipsoidsAreExactOnTheirSurfaceAndAxes) {
  const Vector3 radii{0.5, 1, 2}, centre{1, 2, 3};
  for (double t = 0; t < 6; t += 0.37) {
    const Vector3 on{radii.x * std::cos(t) * std::cos(2 * t),
                     radii.y * std::sin(t) * std::cos(2 * t), radii.z * std::sin(2 * t)};
    EXPECT_NEAR(ellipsoidDistance(centre + on, centre, radii), 0, 1e-12) << t;
  }
  EXPECT_NEAR(ellipsoidDistance({1, 2, 8}, centre, radii), 3, 1e-12);
  EXPECT_LT(ellipsoidDistance(centre, centre, radii), 0);
}

TEST(SignedDistance, RodsTaper) {
  const Vector3 a{0, 0, 0}, b{0, 2, 0};
  EXPECT_NEAR(rodDistance({1, 0, 0}, a, b, 0.5, 0.1), 0.5, 1e-12);
  EXPECT_NEAR(rodDistance({1, 2, 0}, a, b, 0.5, 0.1), 0.9, 1e-12);
  EXPECT_NEAR(rodDistance({1, 1, 0}, a, b, 0.5, 0.1), 0.7, 1e-12);
  EXPECT_NEAR(rodDistance({0, 4, 0}, a, b, 0.5, 0.1), 1.9, 1e-12);
}

std::size_t openEdges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : balance) open += count != 0 ? 1 : 0;
  return open;
}

double volumeOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += dot(vectorOf(mesh.positions[t[0]]),
               cross(vectorOf(mesh.positions[t[1]]), vectorOf(mesh.positions[t[2]])));
  }
  return sum / 6;
}

TEST(Isosurface, OfASphereIsClosedRoundAndFacesOutward) {
  const Vector3 centre{0.03, -0.02, 0.05};
  const auto sphere = [&](Vector3 p) { return sphereDistance(p, centre, 0.8); };
  const TriangleMesh mesh = isosurface(sphere, {{-1, -1, -1}, {1, 1, 1}}, 0.04);
  EXPECT_EQ(openEdges(mesh), 0u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vector3 out = vectorOf(mesh.positions[i]) - centre;
    EXPECT_NEAR(length(out), 0.8, 0.001);
    EXPECT_GT(dot(vectorOf(mesh.normals[i]), out) / length(out), 0.999);
  }
  EXPECT_NEAR(volumeOf(mesh), 4.0 / 3 * std::numbers::pi * 0.512, 0.01);
}

TEST(Isosurface, TwoBodiesAndAHoleStayApart) {
  const auto shape = [](Vector3 p) {
    const double ring = lengthOf({std::hypot(p.x, p.y) - 0.5, p.z, 0}) - 0.2;
    return std::min(ring, sphereDistance(p, {0, 0, 0.9}, 0.3));
  };
  const TriangleMesh mesh = isosurface(shape, {{-1, -1, -1}, {1, 1, 1.5}}, 0.03);
  EXPECT_EQ(openEdges(mesh), 0u);
  const double ring = 2 * std::numbers::pi * std::numbers::pi * 0.5 * 0.04;
  EXPECT_NEAR(volumeOf(mesh), ring + 4.0 / 3 * std::numbers::pi * 0.027, 0.01);
  // Euler's number: 2 for the sphere, 0 for the ring.
  const auto vertices = static_cast<double>(mesh.positions.size());
  EXPECT_EQ(vertices - static_cast<double>(mesh.triangles.size()) / 2, 2);
}

TEST(RodCloud, IsTheUnionOfItsRodsWithinReach) {
  std::vector<Strand> strands;
  for (int i = 0; i < 6; ++i) {
    Strand strand;
    for (int k = 0; k < 5; ++k) {
      strand.points.push_back({std::cos(i + 0.3 * k), 0.2 * k, std::sin(1.7 * i + 0.2 * k)});
      strand.radii.push_back(0.05 + 0.01 * k);
    }
    strand.outward = {0.3, 0.1, 1};
    strands.push_back(strand);
  }
  constexpr double kReach = 0.2;
  const RodCloud cloud(strands, 1e-6, kReach);
  int near = 0;
  for (double x = -1.3; x < 1.3; x += 0.11) {
    for (double y = -0.3; y < 1.2; y += 0.13) {
      for (double z = -1.3; z < 1.3; z += 0.12) {
        const Vector3 p{x, y, z};
        double expected = kReach;
        for (const Strand& s : strands) {
          for (std::size_t k = 0; k + 1 < s.points.size(); ++k)
            expected = std::min(
                expected, rodDistance(p, s.points[k], s.points[k + 1], s.radii[k], s.radii[k + 1]));
        }
        ASSERT_NEAR(cloud.distance(p), expected, 1e-5) << x << ' ' << y << ' ' << z;
        near += expected < kReach ? 1 : 0;
      }
    }
  }
  EXPECT_GT(near, 100);
}

TEST(Fur, RootsAreOnTheSkinTipsOutsideAndBaldPlacesBald) {
  const FurryPart body{{.translation = {0, 0, 0}}, {0.5, 0.7, 0.4}, 0.1, {1, 1, 1}};
  const FurryPart head{{.translation = {0, 0.9, 0}}, {0.4, 0.4, 0.4}, 0.1, {1, 1, 1}};
  const FurryPart eye{{.translation = {0, 1, 0.38}}, {0.1, 0.1, 0.1}, 0, {}};
  const std::array parts{body, head};
  const CurveSet fur = furOn(parts, std::array{eye}, 3000, 7);
  ASSERT_GT(fur.firstPoints.size(), 2000u);
  EXPECT_LT(fur.firstPoints.size(), 3000u) << "where the parts overlap there is no skin";
  const auto skin = [&](Vector3 p) {
    return std::min(distanceFrom(body, p), distanceFrom(head, p));
  };
  const auto pointOf = [&](std::size_t i) {
    return Vector3{fur.points[i][0], fur.points[i][1], fur.points[i][2]};
  };
  std::size_t outside = 0;
  for (std::size_t i = 0; i < fur.firstPoints.size(); ++i) {
    const std::size_t end =
        i + 1 < fur.firstPoints.size() ? fur.firstPoints[i + 1] : fur.points.size();
    const Vector3 root = pointOf(fur.firstPoints[i] + 1), tip = pointOf(end - 2);
    EXPECT_NEAR(skin(root), 0, 0.03) << i;
    EXPECT_GT(distanceFrom(eye, root), -0.001) << i;
    outside += skin(tip) > 0.02 ? 1 : 0;
  }
  EXPECT_GT(outside, fur.firstPoints.size() * 9 / 10);
}

TEST(Fur, IsEvenOverAnEllipsoid) {
  const FurryPart body{{}, {1, 0.25, 0.25}, 0.001, {1, 1, 1}};
  const CurveSet fur = furOn(std::array{body}, {}, 20000, 3);
  std::size_t middle = 0;
  for (const std::uint32_t first : fur.firstPoints)
    middle += std::abs(fur.points[first + 1][0]) < 0.5 ? 1 : 0;
  // The share of a prolate spheroid's area between +-half its longer axis, by quadrature.
  const auto ring = [](double x) {
    const double r = 0.25 * std::sqrt(1 - x * x), slope = 0.0625 * x / r;
    return r * std::sqrt(1 + slope * slope);
  };
  double inner = 0, all = 0;
  for (double x = -0.99995; x < 1; x += 0.0001) {
    all += ring(x);
    inner += std::abs(x) < 0.5 ? ring(x) : 0;
  }
  EXPECT_NEAR(static_cast<double>(middle) / static_cast<double>(fur.firstPoints.size()),
              inner / all, 0.01);
}

TEST(HeightMap, InterpolatesAndBlursWithoutShifting) {
  HeightMap plane(33);
  for (int row = 0; row < 33; ++row) {
    for (int column = 0; column < 33; ++column)
      plane.at(column, row) =
          static_cast<float>(2 * plane.coordinate(column) - plane.coordinate(row));
  }
  EXPECT_NEAR(plane.value(0.123, -0.456), 2 * 0.123 + 0.456, 1e-5);
  EXPECT_NEAR(plane.blurred(2).value(0.1, 0.2), 0, 1e-5) << "means of a plane are the plane";
  EXPECT_NEAR(plane.value(5, 0), 2, 1e-5) << "the edge continues";
}

TEST(CoinLetters, StandOnTheirCircle) {
  // The stem of a single I is upright through the top.
  for (const double y : {0.51, 0.55, 0.59}) {
    EXPECT_NEAR(distanceToLetters("I", 0.5, 0.1, 0, y), 0, 0.002) << y;
    EXPECT_NEAR(distanceToLetters("I", 0.5, 0.1, 0.05, y), 0.045, 0.01) << y;
  }
  EXPECT_NEAR(distanceToLetters("I", 0.5, 0.1, 0, 0.65), 0.05, 0.002) << "above it";
  EXPECT_NEAR(distanceToLetters("I", 0.5, 0.1, 0, 0.45), 0.05, 0.002) << "below it";
  EXPECT_THROW(distanceToLetters("Q", 0.5, 0.1, 0, 0.5), Error);
}

}  // namespace
}  // namespace illum
