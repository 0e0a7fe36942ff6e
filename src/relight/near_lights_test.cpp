#include "relight/near_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "relight/matt_object_for_test.h"
#include "relight/passes.h"

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;
// Of the table's interpolation and of codes of 16 bits.
constexpr double kTable = 2e-4;

/// Red of each texel.
std::vector<double> underNear(const MattObject& object, Response response,
                              const std::vector<Vector3>& points, const Lighting& lighting) {
  const NearLights lights(object.basis, object.coding, response, illuminationOf(lighting).nearby);
  std::vector<float> rgb(3 * points.size());
  std::vector<float> scratch;
  lights.addTo(rgb, object.planes(), 0, points, scratch);
  std::vector<double> red;
  for (std::size_t i = 0; i < rgb.size(); i += 3) red.push_back(rgb[i]);
  return red;
}

std::vector<double> underDirectional(const MattObject& object, const DirectionalLight& light) {
  std::vector<float> rgb(3 * object.codes.tile.pixels()), scratch;
  Passes(object.basis, object.coding, Response::Linear, std::span(&light, 1))
      .relight(object.planes(), 0, rgb, scratch);
  std::vector<double> red;
  for (std::size_t i = 0; i < rgb.size(); i += 3) red.push_back(rgb[i]);
  return red;
}

/// A plane z = 0 from x = -1 to 1, and a ball of radius 0.5, its front half.
struct Scene {
  std::vector<Vector3> points, normals;
  Scene() {
    for (double x = -1; x <= 1; x += 0.1) {
      points.push_back({x, 0.2 * x, 0});
      normals.push_back({0, 0, 1});
    }
    for (double t = -1.2; t <= 1.2; t += 0.1) {
      normals.push_back({std::sin(t), 0.3 * std::cos(t), std::sqrt(0.91) * std::cos(t)});
      points.push_back(0.5 * normals.back());
    }
  }
};

/// The texel's cosine and 1 / d^2, negative where it faces away.
double closedForm(Vector3 point, Vector3 normal, Vector3 lamp) {
  const Vector3 toLight = lamp - point;
  const double d = length(toLight);
  return dot(normal, toLight) / (d * d * d);
}

TEST(NearLights, PlaneAndBallHaveTheirClosedForm) {
  const Scene scene;
  const MattObject object(scene.normals);
  for (const Vector3 lamp : {Vector3{0, 0, 1}, {0.7, -0.3, 0.6}, {2, 1, 3}}) {
    const auto lit = underNear(object, Response::Linear, scene.points, {{PointLight{lamp}}});
    for (std::size_t i = 0; i < lit.size(); ++i) {
      const double squared = dot(lamp - scene.points[i], lamp - scene.points[i]);
      EXPECT_NEAR(lit[i], closedForm(scene.points[i], scene.normals[i], lamp), kTable / squared)
          << "texel " << i << ", lamp at z = " << lamp.z;
    }
  }
}

TEST(NearLights, FarAwayTheyAreDirectionalWithAnErrorOfOneOverD) {
  const Scene scene;
  const MattObject object(scene.normals);
  const Direction toward = Direction::fromVector({0.3, 0.5, 0.8});
  const auto truth = underDirectional(object, {toward, {1, 1, 1}});
  double before = 0;
  for (const double d : {10.0, 100.0, 1000.0}) {
    const auto intensity = static_cast<float>(d * d);
    const PointLight lamp{d * toward.vector(), {intensity, intensity, intensity}, {}};
    const auto lit = underNear(object, Response::Linear, scene.points, {{lamp}});
    double worst = 0;
    for (std::size_t i = 0; i < lit.size(); ++i)
      worst = std::max(worst, std::abs(lit[i] - truth[i]));
    if (before > 0) {
      EXPECT_GT(before / worst, 8) << d;
      EXPECT_LT(before / worst, 12) << d;
    }
    before = worst;
  }
  EXPECT_LT(before, 4e-3);
}

TEST(NearLights, SpotsCutTheirConeOutOfThePlane) {
  std::vector<Vector3> points;
  for (double x = -1; x <= 1; x += 0.05) points.push_back({x, 0, 0});
  const MattObject object(std::vector<Vector3>(points.size(), {0, 0, 1}));
  const SpotLight spot{{0, 0, 1}, {0, 0, 0}, 30, 6, {1, 1, 1}, Falloff::None};
  const auto lit = underNear(object, Response::Linear, points, {{spot}});
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const double degrees = std::atan(std::abs(points[i].x)) * 180 / kPi;
    const double cosine = std::cos(degrees * kPi / 180);
    if (degrees < 24) {
      EXPECT_NEAR(lit[i], cosine, kTable) << degrees;
    } else if (degrees > 30) {
      EXPECT_EQ(lit[i], 0) << degrees;
    } else {
      EXPECT_LT(lit[i], cosine);
      EXPECT_GT(lit[i], 0);
    }
  }
}

TEST(NearLights, FalloffsAreThoseOfTheLight) {
  const MattObject object({{0, 0, 1}});
  for (const auto& [falloff, expected] :
       {std::pair{Falloff::InverseSquare, 0.25}, {Falloff::Inverse, 0.5}, {Falloff::None, 1.0}}) {
    const PointLight lamp{{0, 0, 2}, {1, 1, 1}, falloff};
    EXPECT_NEAR(underNear(object, Response::Linear, {{0, 0, 0}}, {{lamp}})[0], expected, kTable);
  }
}

// Over a square parallel to it, the whole of which it sees; Howell's catalogue, B-3 for a corner.
double squareFormFactor(double halfSide, double height) {
  const double x = halfSide / height, s = std::sqrt(1 + x * x);
  return 4 / (2 * kPi) * (2 * x / s * std::atan(x / s));
}

TEST(NearLights, PanelsConvergeWithTheirSamples) {
  const MattObject object({{0, 0, 1}});
  const double half = 0.5, height = 0.4;
  // Radiance 1: intensity = area / pi.
  const auto intensity = static_cast<float>(4 * half * half / kPi);
  double before = 1;
  for (const int n : {2, 4, 8, 16}) {
    const RectangleLight panel{
        {0, 0, height}, {half, 0, 0}, {0, -half, 0}, {intensity, intensity, intensity}, n, n};
    const double lit = underNear(object, Response::Linear, {{0, 0, 0}}, {{panel}})[0];
    const double error = std::abs(lit - squareFormFactor(half, height));
    EXPECT_LT(error, before / 2.5) << n;
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

TEST(NearLights, BallsConvergeWithTheirSamples) {
  const MattObject object({{0, 0, 1}});
  const float intensity = 0.2F * 0.2F;  // radiance 1 at a radius of 0.2
  for (const int samples : {64, 1024}) {
    const SphereLight ball{{0, 0, 0.5}, 0.2, {intensity, intensity, intensity}, samples};
    const double lit = underNear(object, Response::Linear, {{0, 0, 0}}, {{ball}})[0];
    EXPECT_NEAR(lit, 0.16, samples == 64 ? 8e-3 : 1e-3) << samples;  // (r / d)^2
  }
}

TEST(NearLights, AddUpExactlyBehindTheResponse) {
  const Scene scene;
  const MattObject object(scene.normals);
  const PointLight a{{0.5, 0, 1}, {0.3F, 1, 1}, {}}, b{{-1, 0.4, 0.5}, {0.9F, 1, 1}, {}};
  for (const Response response : {Response::Linear, Response::Display, Response::Cone}) {
    const auto one = underNear(object, response, scene.points, {{a}});
    const auto other = underNear(object, response, scene.points, {{b}});
    const auto both = underNear(object, response, scene.points, {{a, b}});
    for (std::size_t i = 0; i < both.size(); ++i)
      EXPECT_NEAR(both[i], one[i] + other[i], 1e-6 * (1 + std::abs(both[i])));
  }
}

TEST(NearLights, GiveNothingWhereNothingIs) {
  const MattObject object({{0, 0, 1}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(underNear(object, Response::Linear, {{nan, nan, nan}}, {{PointLight{{0, 0, 1}}}})[0],
            0);
}

}  // namespace
}  // namespace illum
