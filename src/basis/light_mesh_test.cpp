#include "basis/light_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "basis/light_sum.h"
#include "illum/error.h"

namespace illum {
namespace {

using testing::HasSubstr;
using Triangle = LightMesh::Triangle;

// Five lights and the south pole, which closes the octahedron.
struct Parts {
  std::vector<Vector3> sites{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  int lights = 5;
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1},
                                  {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
  LightMesh mesh() const { return {sites, lights, triangles, "mesh"}; }
};

std::vector<double> weightsAt(const LightMesh& mesh, Vector3 v) {
  std::vector<double> weights(static_cast<std::size_t>(mesh.lights()));
  mesh.forEachWeight(Direction::fromVector(v),
                     [&](std::size_t light, double weight) { weights[light] += weight; });
  return weights;
}

std::string errorOf(const std::function<void(Parts&)>& change) {
  Parts parts;
  change(parts);
  try {
    parts.mesh();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(LightMesh, ALightCountsAloneInItsOwnDirection) {
  const Parts parts;
  const LightMesh mesh = parts.mesh();
  for (std::size_t light = 0; light < 5; ++light) {
    std::vector<double> expected(5);
    expected[light] = 1;
    EXPECT_EQ(weightsAt(mesh, parts.sites[light]), expected);
    EXPECT_EQ(weightsAt(mesh, parts.sites[light] + Vector3{3e-7, -2e-7, 1e-7}), expected);
  }
}

TEST(LightMesh, BetweenLightsWeightsAreBarycentric) {
  const LightMesh mesh = Parts().mesh();
  const auto weights = weightsAt(mesh, {1, 2, 5});  // on the plane x + y + z = 1: (1, 2, 5) / 8
  EXPECT_NEAR(weights[0], 5 / 8.0, 1e-15);
  EXPECT_NEAR(weights[1], 1 / 8.0, 1e-15);
  EXPECT_NEAR(weights[2], 2 / 8.0, 1e-15);
  EXPECT_EQ(weights[3], 0);
  const auto edge = weightsAt(mesh, {0, 3, 1});
  EXPECT_NEAR(edge[2], 0.75, 1e-15);
  EXPECT_NEAR(edge[0], 0.25, 1e-15);
}

TEST(LightMesh, AClosingDirectionIsTheMeanOfTheLightsAroundIt) {
  const LightMesh mesh = Parts().mesh();
  EXPECT_THAT(weightsAt(mesh, {0, 0, -1}), testing::ElementsAre(0, 0.25, 0.25, 0.25, 0.25));
  const auto half = weightsAt(mesh, {1, 0, -1});
  EXPECT_NEAR(half[1], 0.5 + 0.125, 1e-15);
  EXPECT_NEAR(half[3], 0.125, 1e-15);
}

TEST(LightMesh, IsAnExactBasisOfThePicturesThemselves) {
  const LightBasis basis(std::make_shared<const LightMesh>(Parts().mesh()));
  ASSERT_EQ(basis.planes(), 15);
  EXPECT_EQ(basis.colour().kind, BasisColour::Kind::Exact);
  EXPECT_EQ(basis.domain(), LightDomain::Sphere);
  std::vector<float> b(basis.evaluateSize());
  basis.evaluate(Direction::fromVector({0, 1, 0}), b);
  for (std::size_t i = 0; i < b.size(); ++i) {
    const std::size_t plane = i / 3;
    EXPECT_EQ(b[i], plane / 3 == 2 && plane % 3 == i % 3 ? 1 : 0) << i;
  }
}

TEST(LightMesh, LightsAddUp) {
  const LightBasis basis(std::make_shared<const LightMesh>(Parts().mesh()));
  LightSum sum(basis), other = sum.emptyCopy();
  std::vector<double> expected(basis.evaluateSize());
  std::vector<float> one(basis.evaluateSize());
  std::mt19937 random(5);
  std::normal_distribution<double> coordinate;
  for (int i = 0; i < 100; ++i) {
    const auto d =
        Direction::fromVector({coordinate(random), coordinate(random), coordinate(random)});
    (i % 2 == 0 ? sum : other).add(d, {0.5F, 1, 2});
    basis.evaluate(d, one);
    const std::array<double, 3> intensity{0.5, 1, 2};
    for (std::size_t k = 0; k < one.size(); ++k)
      expected[k] += intensity[k % 3] * static_cast<double>(one[k]);
  }
  sum.add(other);
  const auto weights = sum.weights(basis);
  ASSERT_EQ(weights.size(), expected.size());
  for (std::size_t k = 0; k < weights.size(); ++k) EXPECT_NEAR(weights[k], expected[k], 1e-4);
}

TEST(LightMesh, BytesComeBack) {
  const LightMesh mesh = Parts().mesh();
  const auto bytes = mesh.encode();
  EXPECT_EQ(bytes.size(), 16 + 6 * 24 + 8 * 6);
  const LightMesh again = LightMesh::decode(bytes, "mesh");
  EXPECT_EQ(again.encode(), bytes);
  EXPECT_EQ(again.lights(), 5);
}

TEST(LightMesh, TheFirstBytesAreFrozen) {
  const auto bytes = Parts().mesh().encode();
  const std::vector<int> expected{'I', 'L', 'B', 'D', 1, 0, 0, 0, 5, 0, 0,    0,   1, 0,
                                  0,   0,   0,   0,   0, 0, 0, 0, 0, 0, 0,    0,   0, 0,
                                  0,   0,   0,   0,   0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << i;
  EXPECT_EQ(std::to_integer<int>(bytes[16 + 6 * 24 + 2]), 1) << "corner 1 of triangle 0";
}

TEST(LightMesh, EveryTruncationIsRefused) {
  const auto bytes = Parts().mesh().encode();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(LightMesh::decode(std::span(bytes).first(size), "mesh"), Error) << size;
  auto longer = bytes;
  longer.push_back({});
  EXPECT_THROW(LightMesh::decode(longer, "mesh"), Error);
}

TEST(LightMesh, FlippedBytesAreRefusedOrHarmless) {
  const auto bytes = Parts().mesh().encode();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int bit : {0, 3, 6, 7}) {
      auto changed = bytes;
      changed[i] ^= static_cast<std::byte>(1 << bit);
      try {
        const LightMesh mesh = LightMesh::decode(changed, "mesh");
        double sum = 0;
        for (const double weight : weightsAt(mesh, {0.3, -0.4, -0.5})) sum += weight;
        EXPECT_NEAR(sum, 1, 1e-12);
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("mesh: expected"));
      }
    }
  }
}

TEST(LightMesh, WhatIsNoCoverOfTheSphereIsRefused) {
  EXPECT_THAT(errorOf([](Parts& p) { p.sites[0].z = 1.1; }), HasSubstr("length 1"));
  EXPECT_THAT(errorOf([](Parts& p) { p.triangles.pop_back(); }), HasSubstr("as many triangles"));
  EXPECT_THAT(errorOf([](Parts& p) { p.triangles[0] = {0, 1, 9}; }), HasSubstr("corners below 6"));
  EXPECT_THAT(errorOf([](Parts& p) { p.triangles[0] = {0, 2, 1}; }), HasSubstr("overlap"));
  EXPECT_THAT(errorOf([](Parts& p) { p.triangles[7] = p.triangles[0]; }), HasSubstr("overlap"));
  EXPECT_THAT(errorOf([](Parts& p) {
                p.triangles[0] = {0, 1, 5};
              }),
              testing::AnyOf(HasSubstr("overlap"), HasSubstr("alone")));
  EXPECT_THAT(errorOf([](Parts& p) {
                for (Triangle& t : p.triangles) std::swap(t[0], t[1]);
              }),
              HasSubstr("counter-clockwise"));
  EXPECT_THAT(errorOf([](Parts& p) { p.lights = 0; }), HasSubstr("1 to 768 lights"));
  EXPECT_THAT(errorOf([](Parts& p) {
                p.sites.resize(3);
                p.lights = 3;
                p.triangles.resize(2);
              }),
              HasSubstr("as many triangles"));
}

TEST(LightMesh, TrianglesThatAreNotDelaunaysAreRefused) {
  // A corner below the equator between two of it: the edge from the pole to it would be Delaunay's.
  Parts parts;
  const double c = 2 / std::sqrt(5), s = 1 / std::sqrt(5);
  parts.sites[1] = {c, s, 0};
  parts.sites[2] = {0, c, -s};
  parts.sites[3] = {-c, s, 0};
  parts.triangles[0] = {0, 1, 3};
  parts.triangles[1] = {1, 2, 3};
  try {
    parts.mesh();
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("Delaunay"));
  }
}

}  // namespace
}  // namespace illum
