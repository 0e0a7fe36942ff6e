// What lights at infinity come down to: one pass for linear objects, few for others.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "illum/lighting.h"
#include "light/median_cut.h"
#include "relight/environment_reduction.h"
#include "relight/matt_object_for_test.h"
#include "relight/passes.h"

namespace illum {
namespace {

std::vector<Vector3> manyNormals() {
  std::vector<Vector3> normals;
  for (int i = 0; i < 200; ++i) {
    const double z = 1 - (i + 0.5) / 200, angle = 2.4 * i, r = std::sqrt(1 - z * z);
    normals.push_back((0.3 + 0.6 * (i % 7) / 6) *
                      Vector3{r * std::cos(angle), r * std::sin(angle), z});
  }
  return normals;
}

std::vector<float> relit(const MattObject& object, Response response,
                         std::span<const DirectionalLight> lights,
                         std::span<const Environment> environments = {}) {
  std::vector<float> rgb(3 * object.codes.tile.pixels()), scratch;
  Passes(object.basis, object.coding, response, lights, environments)
      .relight(object.planes(), 0, rgb, scratch);
  return rgb;
}

/// Uneven, with a small bright lamp and coloured rest.
Picture roomMap(Size size) {
  Picture map(size, 3);
  std::mt19937 random(7);
  for (float& s : map.samples()) s = 0.2F + 0.1F * static_cast<float>(random() % 1000) / 1000;
  for (int y = size.height / 8; y < size.height / 6; ++y) {
    for (int x = size.width / 4; x < size.width / 4 + size.width / 32; ++x) map.at(x, y, 0) = 60;
  }
  return map;
}

TEST(DistantLights, OneBrightTexelIsTheDirectionalLight) {
  const MattObject object(manyNormals());
  Picture map({64, 32}, 3);
  map.at(40, 9, 0) = 500;
  map.at(40, 9, 2) = 80;
  const Environment environment(map);
  const DirectionalLight light = environment.texel(40, 9);
  const auto one = relit(object, Response::Linear, std::span(&light, 1));
  const auto all = relit(object, Response::Linear, {}, std::span(&environment, 1));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_FLOAT_EQ(all[i], one[i]);
  for (const Response response : {Response::Display, Response::Cone}) {
    const auto reduced =
        reduceEnvironment(environment, object.basis, object.coding, response, object.codes, 0.005);
    ASSERT_EQ(reduced.lights.size(), 1U);
    EXPECT_EQ(reduced.lights[0].intensity, light.intensity);
    EXPECT_LT(angleRadians(reduced.lights[0].toLight, light.toLight), 1e-7);
  }
}

// Under radiance 1 from everywhere the white matt surface has the integral of max(0, cos) / pi = 1
// (the cone response cuts the cosine), so that an albedo a gives a.
TEST(DistantLights, UniformLightGivesAMattSurfaceItsAlbedo) {
  const std::vector<Vector3> normals = manyNormals();
  const MattObject object(normals);
  Picture map({128, 64}, 3);
  for (float& s : map.samples()) s = 1;
  const auto reduced = reduceEnvironment(Environment(map), object.basis, object.coding,
                                         Response::Cone, object.codes, 0.005);
  const auto lit = relit(object, Response::Cone, reduced.lights);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_NEAR(lit[3 * i + 1], length(normals[i]), 0.02 * length(normals[i])) << i;
}

TEST(DistantLights, LinearObjectsAreLinear) {
  const MattObject object(manyNormals());
  const Environment room(roomMap({64, 32}));
  const DirectionalLight sun{Direction::fromVector({1, 2, 2}), {3, 2, 1}};
  const float a = 0.7F, b = 2.5F;
  Picture scaled = room.radiance();
  for (float& s : scaled.samples()) s *= b;
  const Environment scaledRoom(scaled);
  const DirectionalLight scaledSun{sun.toLight, a * sun.intensity};
  const auto first = relit(object, Response::Linear, std::span(&sun, 1));
  const auto second = relit(object, Response::Linear, {}, std::span(&room, 1));
  const auto both =
      relit(object, Response::Linear, std::span(&scaledSun, 1), std::span(&scaledRoom, 1));
  for (std::size_t i = 0; i < both.size(); ++i)
    EXPECT_NEAR(both[i], a * first[i] + b * second[i], 4e-6) << i;
}

// A ring of normals turned by a step is the same ring: so turning the map (the environment, as the
// camera sees it) turns the picture.
TEST(DistantLights, TurningLightAndSceneTogetherChangesNothing) {
  constexpr int kRing = 24;
  std::vector<Vector3> normals;
  for (int i = 0; i < kRing; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRing;
    normals.push_back({0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.8});
  }
  const MattObject object(normals);
  const Environment room(roomMap({128, 64}));
  const int steps = 5;
  const Environment turned =
      room.turned(rotationAbout(Direction(), 2 * std::numbers::pi * steps / kRing));
  const auto before = relit(object, Response::Linear, {}, std::span(&room, 1));
  const auto after = relit(object, Response::Linear, {}, std::span(&turned, 1));
  for (std::size_t i = 0; i < kRing; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(after[3 * ((i + steps) % kRing) + c], before[3 * i + c],
                  3e-4 * std::abs(before[3 * i + c]) + 3e-4)
          << i;
    }
  }
}

TEST(DistantLights, AnyNumberOfLinearLightsIsOnePass) {
  const MattObject object(manyNormals());
  const Environment room(roomMap({64, 32}));
  const std::vector<DirectionalLight> lights(1000);
  EXPECT_EQ(
      Passes(object.basis, object.coding, Response::Linear, lights, std::span(&room, 1)).count(),
      1);
  EXPECT_EQ(Passes(object.basis, object.coding, Response::Display, lights).count(), 1000);
}

// The bound is kept not only where it was measured but against every texel of the map.
TEST(EnvironmentReduction, KeepsItsBoundWithFewDirections) {
  const MattObject object(manyNormals());
  const Environment room(roomMap({128, 64}));
  std::vector<DirectionalLight> texels;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) texels.push_back(room.texel(x, y));
  }
  for (const Response response : {Response::Display, Response::Cone}) {
    const auto truth = relit(object, response, texels);
    std::size_t before = 0;
    for (const double bound : {0.05, 0.02, 0.005}) {
      const auto reduced = reduceEnvironment(room, object.basis, object.coding, response,
                                             probeOf(object.codes, 60), bound);
      const auto lit = relit(object, response, reduced.lights);
      double squares = 0, all = 0;
      for (std::size_t i = 0; i < lit.size(); ++i) {
        squares += std::pow(lit[i] - truth[i], 2);
        all += std::pow(truth[i], 2);
      }
      EXPECT_LE(reduced.error, bound);
      EXPECT_LT(std::sqrt(squares / all), 1.5 * bound) << reduced.lights.size() << " directions";
      EXPECT_LE(reduced.lights.size(), static_cast<std::size_t>(kMostDirections));
      EXPECT_GE(reduced.lights.size(), before) << "a smaller bound takes more";
      before = reduced.lights.size();
    }
  }
}

TEST(EnvironmentReduction, TakesNoMoreThanItNeeds) {
  const MattObject object(manyNormals());
  const Environment room(roomMap({128, 64}));
  const MedianCut cut(room, kReferenceRegions);
  const auto reduced =
      reduceEnvironment(room, object.basis, object.coding, Response::Cone, object.codes, 0.01);
  const auto reference = relit(object, Response::Cone, cut.lights(kReferenceRegions));
  const auto half =
      relit(object, Response::Cone, cut.lights(static_cast<int>(reduced.lights.size()) / 2));
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < half.size(); ++i) {
    squares += std::pow(half[i] - reference[i], 2);
    all += std::pow(reference[i], 2);
  }
  EXPECT_GT(std::sqrt(squares / all), 0.01) << "half of " << reduced.lights.size() << " would do";
}

}  // namespace
}  // namespace illum
