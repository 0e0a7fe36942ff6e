#include "normals/photometric_stereo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace illum {
namespace {

using Method = NormalOptions::Method;

/// Evenly over a cap about +z.
std::vector<Direction> dome(int count, double lowestZ) {
  std::vector<Direction> lights;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (1 - lowestZ) * (i + 0.5) / count;
    lights.push_back(Direction::fromAngles(std::acos(z), 2.399963 * i));
  }
  return lights;
}

double degreesBetween(const std::optional<Vector3>& n, Vector3 truth) {
  return angleRadians(Direction::fromVector(n.value()), Direction::fromVector(truth)) * 180 /
         std::numbers::pi;
}

std::vector<float> lambertian(const std::vector<Direction>& lights, Vector3 n, double albedo) {
  std::vector<float> brightness;
  for (const Direction& light : lights)
    brightness.push_back(static_cast<float>(albedo * std::max(0.0, dot(n, light.vector()))));
  return brightness;
}

const std::vector<Vector3> kNormals{
    {0, 0, 1}, {0.6, 0, 0.8}, {0, -0.6, 0.8}, {-0.48, 0.64, 0.6}, {0.8, 0, 0.6}};

TEST(PhotometricStereo, IsExactOnMattSurfacesWithAttachedShadows) {
  const auto lights = dome(60, 0.2);
  std::vector<float> scratch;
  for (const Vector3& n : kNormals) {
    for (const double albedo : {0.02, 0.9}) {
      const PhotometricStereo stereo(lights, Method::Robust);
      EXPECT_LT(degreesBetween(stereo.normal(lambertian(lights, n, albedo), scratch), n), 0.01)
          << n.x << ' ' << n.y << ' ' << n.z << ", albedo " << albedo;
    }
  }
}

TEST(PhotometricStereo, LeastSquaresIsExactWhereEveryLightReaches) {
  const auto lights = dome(20, 0.8);
  std::vector<float> scratch;
  const Vector3 n{0.3, -0.2, std::sqrt(1 - 0.13)};
  const PhotometricStereo stereo(lights, Method::LeastSquares);
  EXPECT_LT(degreesBetween(stereo.normal(lambertian(lights, n, 0.5), scratch), n), 1e-3);
}

TEST(PhotometricStereo, HighlightsAndCastShadowsDoNotMislead) {
  const auto lights = dome(80, 0.3);
  std::vector<float> scratch;
  const PhotometricStereo robust(lights, Method::Robust), plain(lights, Method::LeastSquares);
  for (const Vector3& n : kNormals) {
    std::vector<float> brightness = lambertian(lights, n, 0.4);
    for (std::size_t j = 0; j < lights.size(); ++j) {
      const Direction half = Direction::fromVector(lights[j].vector() + Vector3{0, 0, 1});
      const double across = dot(half.vector(), n);
      brightness[j] += static_cast<float>(std::pow(std::max(0.0, across), 100));
      if (lights[j].x() < -0.5) brightness[j] *= 0.05F;  // something stands on the left
    }
    const double error = degreesBetween(robust.normal(brightness, scratch), n);
    EXPECT_LT(error, 1.5) << n.x << ' ' << n.y << ' ' << n.z;
    EXPECT_LT(5 * error, degreesBetween(plain.normal(brightness, scratch), n));
  }
}

TEST(PhotometricStereo, DoesNotDependOnTheOrderOfLights) {
  auto lights = dome(30, 0.3);
  auto brightness = lambertian(lights, {0.48, 0.64, 0.6}, 0.7);
  std::vector<float> scratch;
  const auto n = PhotometricStereo(lights, Method::Robust).normal(brightness, scratch);
  std::reverse(lights.begin(), lights.end());
  std::reverse(brightness.begin(), brightness.end());
  const auto reversed = PhotometricStereo(lights, Method::Robust).normal(brightness, scratch);
  EXPECT_LT(degreesBetween(n, *reversed), 1e-4);
}

TEST(PhotometricStereo, BlackTellsNothing) {
  const auto lights = dome(10, 0.5);
  std::vector<float> scratch;
  for (const Method method : {Method::Robust, Method::LeastSquares})
    EXPECT_FALSE(PhotometricStereo(lights, method).normal(std::vector<float>(10), scratch));
}

TEST(PhotometricStereo, LightsOfOnePlaneTellNothing) {
  std::vector<Direction> lights;
  for (int i = 0; i < 12; ++i) lights.push_back(Direction::fromAngles(0.1 * (i - 6), 0.3));
  std::vector<float> scratch;
  for (const Method method : {Method::Robust, Method::LeastSquares}) {
    EXPECT_FALSE(
        PhotometricStereo(lights, method).normal(lambertian(lights, {0, 0, 1}, 0.5), scratch));
  }
}

}  // namespace
}  // namespace illum
