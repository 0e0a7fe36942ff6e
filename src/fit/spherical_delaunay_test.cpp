#include "fit/spherical_delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

namespace illum {
namespace {

using std::numbers::pi;

std::vector<Direction> ring(int count, double theta, double turn = 0) {
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i)
    lights.push_back(Direction::fromAngles(theta, turn + 2 * pi * i / count));
  return lights;
}

std::vector<Direction> scattered(int count, bool upperOnly, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> coordinate;
  std::vector<Direction> lights;
  while (static_cast<int>(lights.size()) < count) {
    const Vector3 v{coordinate(random), coordinate(random), coordinate(random)};
    if (!upperOnly || v.z > 0) lights.push_back(Direction::fromVector(v));
  }
  return lights;
}

std::vector<Direction> joined(std::vector<Direction> a, const std::vector<Direction>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Direction> fromVectors(const std::vector<Vector3>& vectors) {
  std::vector<Direction> lights;
  for (const Vector3& v : vectors) lights.push_back(Direction::fromVector(v));
  return lights;
}

std::map<std::string, std::vector<Direction>> lightSets() {
  // An RTI dome: rings of equal elevation, all on circles, and a light at the top.
  std::vector<Direction> dome{Direction()};
  for (int r = 1; r <= 4; ++r) dome = joined(dome, ring(6 * r, 0.36 * r, 0.1 * r));
  return {
      {"one", fromVectors({{0.3, 0.4, 0.5}})},
      {"two", fromVectors({{0.3, 0.4, 0.5}, {-1, 0, 0.2}})},
      {"two near each other", fromVectors({{0, 0, 1}, {1e-3, 0, 1}})},
      {"antipodes", fromVectors({{0, 0, 1}, {0, 0, -1}})},
      {"three", fromVectors({{1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}})},
      {"a quarter of a great circle", fromVectors({{1, 0, 0}, {2, 0, 1}, {1, 0, 1}, {0, 0, 1}})},
      {"a great circle", ring(12, pi / 2)},
      {"half a great circle",
       fromVectors({{1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {-1, 0, 1}, {-1, 0, 0}})},
      {"a small circle", ring(8, 0.8)},
      {"a small circle and its middle", joined(ring(8, 0.8), {Direction()})},
      {"a tetrahedron", fromVectors({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}})},
      {"a cube", fromVectors({{1, 1, 1},
                              {1, 1, -1},
                              {1, -1, 1},
                              {1, -1, -1},
                              {-1, 1, 1},
                              {-1, 1, -1},
                              {-1, -1, 1},
                              {-1, -1, -1}})},
      {"a dome", dome},
      {"a dome down to the horizon", joined(dome, ring(24, pi / 2))},
      {"a dome a little below the horizon", joined(dome, ring(24, pi / 2 + 0.05))},
      {"a cluster", fromVectors({{0, 0, 1}, {0.01, 0, 1}, {0, 0.01, 1}, {-0.01, 0.002, 1}})},
      {"scattered over the hemisphere", scattered(60, true, 1)},
      {"scattered over the sphere", scattered(200, false, 2)},
      {"as many as an object holds", scattered(256, true, 3)},
  };
}

std::vector<double> weightsAt(const LightMesh& mesh, Direction d) {
  std::vector<double> weights(static_cast<std::size_t>(mesh.lights()));
  mesh.forEachWeight(d, [&](std::size_t light, double weight) { weights[light] += weight; });
  return weights;
}

class Meshes : public testing::TestWithParam<std::string> {
 protected:
  Meshes() : lights(lightSets().at(GetParam())), mesh(delaunayMesh(lights)) {}
  std::vector<Direction> lights;
  LightMesh mesh;  // made at all: it covers the sphere once, and no site is within a circle
};

TEST_P(Meshes, EveryLightCountsAloneInItsOwnDirection) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::vector<double> expected(lights.size());
    expected[i] = 1;
    EXPECT_EQ(weightsAt(mesh, lights[i]), expected) << "light " << i;
  }
}

TEST_P(Meshes, WeightsAreNeverNegativeAndOfSumOne) {
  for (const Direction& d : scattered(2000, false, 9)) {
    double sum = 0;
    for (const double weight : weightsAt(mesh, d)) {
      EXPECT_GE(weight, 0);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

// Along great circles, a step of h changes a weight by no more than h over the lowest triangle
// corner's height; jumps would not shrink with h.
TEST_P(Meshes, WeightsAreContinuous) {
  constexpr double kStep = 1e-7;
  // So near to each other that every step is a large part of the way.
  const bool dense =
      GetParam() == "two near each other" || GetParam() == "as many as an object holds";
  for (const Direction& d : scattered(3000, false, 10)) {
    // From the middle of an edge to its one side and the other, and anywhere.
    const auto& triangle = mesh.triangles()[static_cast<std::size_t>(
        std::abs(d.x()) * static_cast<double>(mesh.triangles().size() - 1))];
    const double share = (d.y() + 1) / 2;
    const Vector3 edge =
        share * mesh.sites()[triangle[0]] + (1 - share) * mesh.sites()[triangle[1]];
    for (const Vector3& from : {edge, d.vector()}) {
      const auto a = weightsAt(mesh, Direction::fromVector(from - kStep * d.vector()));
      const auto b = weightsAt(mesh, Direction::fromVector(from + kStep * cross(d.vector(), from)));
      for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(a[i], b[i], dense ? 1e-3 : 2e-4) << "light " << i;
    }
  }
}

TEST_P(Meshes, NoDirectionIsFarFromEveryCorner) {
  for (const auto& t : mesh.triangles()) {
    const Vector3 a = mesh.sites()[t[0]];
    const Vector3 normal = cross(mesh.sites()[t[1]] - a, mesh.sites()[t[2]] - a);
    EXPECT_GE(dot(normal, a) / length(normal), std::cos(kGapRadians) - 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Meshes, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const auto& [name, lights] : lightSets()) names.push_back(name);
                           return names;
                         }()),
                         [](const auto& set) {
                           std::string name = set.param;
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

TEST(DelaunayMesh, ClosesADomeAtTheSouthPoleWithTheMeanOfItsRim) {
  const auto lights = lightSets().at("a dome down to the horizon");
  const LightMesh mesh = delaunayMesh(lights);
  ASSERT_EQ(mesh.sites().size(), lights.size() + 1);
  EXPECT_NEAR(mesh.sites().back().z, -1, 1e-9);
  const auto weights = weightsAt(mesh, Direction::fromVector({0, 0, -1}));
  for (std::size_t i = 0; i < lights.size(); ++i)
    EXPECT_NEAR(weights[i], i + 24 < lights.size() ? 0 : 1 / 24.0, 1e-12) << i;
}

TEST(DelaunayMesh, AddsNothingWhereLightsSurroundTheObject) {
  for (const char* name : {"a tetrahedron", "a cube", "scattered over the sphere"}) {
    const auto lights = lightSets().at(name);
    EXPECT_EQ(delaunayMesh(lights).sites().size(), lights.size()) << name;
  }
}

// The definition itself: nothing lies within the circle of any triangle.
TEST(DelaunayMesh, CirclesAreEmpty) {
  for (const auto& [name, lights] : lightSets()) {
    const LightMesh mesh = delaunayMesh(lights);
    for (const auto& t : mesh.triangles()) {
      const Vector3 a = mesh.sites()[t[0]];
      Vector3 normal = cross(mesh.sites()[t[1]] - a, mesh.sites()[t[2]] - a);
      normal = (1 / length(normal)) * normal;
      for (const Vector3& site : mesh.sites()) ASSERT_LE(dot(normal, site - a), 1e-9) << name;
    }
  }
}

TEST(DelaunayMesh, InterpolatesALinearFunctionsRays) {
  // Barycentric weights give back the direction itself, up to its length.
  const auto lights = lightSets().at("scattered over the sphere");
  const LightMesh mesh = delaunayMesh(lights);
  for (const Direction& d : scattered(500, false, 12)) {
    Vector3 sum;
    const auto weights = weightsAt(mesh, d);
    for (std::size_t i = 0; i < weights.size(); ++i) sum = sum + weights[i] * lights[i].vector();
    EXPECT_LT(length((1 / length(sum)) * sum - d.vector()), 1e-12);
  }
}

TEST(FirstOfSame, FindsLightsFromOneDirection) {
  const auto lights = fromVectors({{0, 0, 1}, {1, 0, 0}, {0, 0, 2}, {1, 1e-6, 0}, {1, 1e-4, 0}});
  EXPECT_EQ(firstOfSame(lights), (std::vector<int>{0, 1, 0, 1, 4}));
}

}  // namespace
}  // namespace illum
