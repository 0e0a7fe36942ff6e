#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "illum/camera.h"
#include "illum/error.h"

namespace illum {
namespace {

PinholeCamera someCamera() {
  PinholeCamera camera;
  camera.objectFromCamera = lookAt({2, 1, 4}, {0.1, 0.2, 0}, {0.1, 1, 0});
  camera.focalX = 310;
  camera.focalY = 290;
  camera.centre = {96.25, 83};
  camera.size = {200, 160};
  return camera;
}

TEST(ProjectionMatrix, TakesPointsToTheirPixels) {
  const PinholeCamera camera = someCamera();
  const ProjectionMatrix m = projectionMatrix(camera);
  for (const Vector3 p : {Vector3{0, 0, 0}, {0.4, -0.3, 0.7}, {-1, 2, -5}}) {
    const double w = m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11];
    const auto seen = pixelOf(camera, p);
    ASSERT_TRUE(seen);
    EXPECT_NEAR((m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]) / w, seen->x, 1e-9);
    EXPECT_NEAR((m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7]) / w, seen->y, 1e-9);
    EXPECT_NEAR(w, depthOf(camera, p), 1e-12);
  }
}

TEST(ProjectionMatrix, DeterminesTheCameraWhateverItsScale) {
  const PinholeCamera camera = someCamera();
  for (const double scale : {1.0, 250.0, -0.01}) {
    ProjectionMatrix m = projectionMatrix(camera);
    for (double& value : m) value *= scale;
    const PinholeCamera back = pinholeFromProjection(m, camera.size);
    EXPECT_NEAR(back.focalX, camera.focalX, 1e-9) << scale;
    EXPECT_NEAR(back.focalY, camera.focalY, 1e-9) << scale;
    EXPECT_NEAR(back.centre.x, camera.centre.x, 1e-9) << scale;
    EXPECT_NEAR(back.centre.y, camera.centre.y, 1e-9) << scale;
    EXPECT_EQ(back.size, camera.size);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_NEAR(back.objectFromCamera.rotation[i], camera.objectFromCamera.rotation[i], 1e-12);
    }
    EXPECT_NEAR(length(back.objectFromCamera.translation - camera.objectFromCamera.translation), 0,
                1e-12);
  }
}

TEST(ProjectionMatrix, RefusesWhatIsNoPinholeCamera) {
  const ProjectionMatrix good = projectionMatrix(someCamera());
  ProjectionMatrix skewed = good, singular = good, infinite = good;
  for (std::size_t i = 0; i < 4; ++i) {
    skewed[i] += 0.001 * good[4 + i];
    singular[8 + i] = good[4 + i];
  }
  infinite[11] = INFINITY;
  const Size size{200, 160};
  EXPECT_NO_THROW(pinholeFromProjection(good, size));
  EXPECT_THROW(pinholeFromProjection(skewed, size), Error);
  EXPECT_THROW(pinholeFromProjection(singular, size), Error);
  EXPECT_THROW(pinholeFromProjection(infinite, size), Error);
  EXPECT_THROW(pinholeFromProjection(ProjectionMatrix{}, size), Error);
}

TEST(ClipMatrix, MakesACubeOfTheFrustum) {
  const PinholeCamera camera = someCamera();
  const auto m = clipFromObject(camera, 0.5, 20);
  const auto clip = [&](Vector3 p) {
    std::array<double, 4> c{};
    for (std::size_t i = 0; i < 4; ++i) {
      c[i] = m[4 * i] * p.x + m[4 * i + 1] * p.y + m[4 * i + 2] * p.z + m[4 * i + 3];
    }
    return std::array<double, 3>{c[0] / c[3], c[1] / c[3], c[2] / c[3]};
  };
  const auto topLeftNear = clip(pointAt(camera, {0, 0}, 0.5));
  EXPECT_NEAR(topLeftNear[0], -1, 1e-9);
  EXPECT_NEAR(topLeftNear[1], 1, 1e-9);
  EXPECT_NEAR(topLeftNear[2], -1, 1e-9);
  const auto bottomRightFar = clip(pointAt(camera, {200, 160}, 20));
  EXPECT_NEAR(bottomRightFar[0], 1, 1e-9);
  EXPECT_NEAR(bottomRightFar[1], -1, 1e-9);
  EXPECT_NEAR(bottomRightFar[2], 1, 1e-9);
}

}  // namespace
}  // namespace illum
