#include "lumigraph/sharpest_plane.h"

#include <gtest/gtest.h>

#include "lumigraph/analytic_scene_for_test.h"

namespace illum {
namespace {

/// 3 x 3 cameras before the scene that all look along -z, without depth.
std::vector<SourceView> parallelCameras(const AnalyticScene& scene, double spacing) {
  std::vector<SourceView> views;
  for (int i = 0; i < 9; ++i) {
    const Vector3 eye{spacing * (i % 3 - 1), spacing * (i / 3 - 1), 2.4};
    const PinholeCamera camera = cameraAt(eye, eye - Vector3{0, 0, 1}, 120);
    views.push_back(seen(scene, {std::to_string(i), camera}, 2));
    views.back().depth = {};
  }
  return views;
}

TEST(SharpestPlane, IsWhereMostOfTheSceneIs) {
  AnalyticScene scene;
  scene.radius = 0.05;  // the wall, then
  const std::vector<SourceView> views = parallelCameras(scene, 0.12);
  const auto plane = sharpestPlane(*viewSource(views));
  ASSERT_TRUE(plane);
  const auto shift = [](double z) { return 0.12 * 1.3 * 120 / (2.4 - z); };  // in pixels
  EXPECT_NEAR(shift(plane->point.z), shift(scene.wallZ), 0.3);
  EXPECT_NEAR(std::abs(plane->normal.z), 1, 1e-9);
}

TEST(SharpestPlane, MakesParallelCamerasAgree) {
  const AnalyticScene scene;
  const std::vector<SourceView> views = parallelCameras(scene, 0.12);
  const auto source = viewSource(views);
  SynthesisOptions focused;
  focused.focus = sharpestPlane(*source);
  ASSERT_TRUE(focused.focus);
  const Vector3 eye{0.06, 0.06, 2.4};
  const PinholeCamera between = cameraAt(eye, eye - Vector3{0, 0, 1}, 120);
  const Picture truth = seen(scene, {"", between}).picture;
  const double far = decibels(synthesise(*source, between).picture, truth);
  EXPECT_GT(decibels(synthesise(*source, between, focused).picture, truth), far + 4);
}

TEST(SharpestPlane, IsNotLookedForWhereItMeansNothing) {
  const AnalyticScene scene;
  EXPECT_FALSE(sharpestPlane(*viewSource(parallelCameras(scene, 0))));
  EXPECT_FALSE(sharpestPlane(*viewSource(seenBySlab(scene, testSlab(2, 40)))));
}

TEST(SharpestPlane, OfDarknessIsInfinity) {
  const AnalyticScene scene;
  std::vector<SourceView> views = parallelCameras(scene, 0.12);
  for (SourceView& view : views) std::ranges::fill(view.picture.samples(), 0.0F);
  EXPECT_FALSE(sharpestPlane(*viewSource(views)));
}

}  // namespace
}  // namespace illum
