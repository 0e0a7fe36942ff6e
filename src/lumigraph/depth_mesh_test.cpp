#include "lumigraph/depth_mesh.h"

#include <gtest/gtest.h>

#include "lumigraph/analytic_scene_for_test.h"

namespace illum {
namespace {

TEST(DepthMesh, JoinsWhatGoesOnAndCutsWhatJumps) {
  EXPECT_TRUE(isJoined(1, 1, 1.1, 1.1, 0.2)) << "a small step";
  EXPECT_FALSE(isJoined(1, 1, 2, 2, 0.2)) << "an edge";
  EXPECT_TRUE(isJoined(1, 2, 3, 4, 0.2)) << "a steep slope";
  EXPECT_FALSE(isJoined(1, 2, 1, 2, 0.2)) << "up and down again";
  EXPECT_FALSE(isJoined(1, 1, kNothing, 1, 0.2));
  EXPECT_FALSE(isJoined(kNothing, kNothing, kNothing, kNothing, 0.2));
  EXPECT_FALSE(isJoined(kNothing, 1, 2, 3, 0.2)) << "a slope that starts there is none";
}

std::vector<View> oneOfEachKind() {
  Panorama panorama;
  panorama.size = {256, 128};
  panorama.objectFromCamera.translation = {0.2, 0.1, 2};
  return {{"slab", SlabView{testSlab(5, 96), 3, 1}},
          {"camera", cameraAt({0.4, 0.3, 2.5}, {0, 0, 0}, 96)},
          {"panorama", panorama},
          {"photograph", OrthographicView{{96, 80}}}};
}

TEST(ViewProjector, SeesAsTheViewDoes) {
  for (const View& view : oneOfEachKind()) {
    const ViewProjector projector(view.geometry);
    for (const Vector3 p : {Vector3{0.1, -0.2, 0.3}, {-0.7, 0.4, -0.5}, {0, 0.01, 0}}) {
      Sighting sighting;
      ASSERT_TRUE(projector.see(p, sighting)) << view.name;
      const auto position = pixelOf(view.geometry, p);
      EXPECT_NEAR(sighting.x, position->x, 1e-9) << view.name;
      EXPECT_NEAR(sighting.y, position->y, 1e-9) << view.name;
      EXPECT_NEAR(projector.depthOf(sighting.range), depthOf(view.geometry, p), 1e-9) << view.name;
      EXPECT_NEAR(projector.rangeOf(depthOf(view.geometry, p)), sighting.range, 1e-9);
      const Vector3 back = projector.pointAt(sighting.x, sighting.y, sighting.range);
      EXPECT_NEAR(length(back - p), 0, 1e-9) << view.name;
      const Ray along = projector.ray(sighting.x, sighting.y);
      EXPECT_NEAR(length(cross(along.direction, p - along.origin)) / length(along.direction), 0,
                  1e-9);
      EXPECT_NEAR(length(cross(projector.towardEye(p), along.direction)), 0, 1e-9);
    }
    EXPECT_EQ(projector.rangeOf(INFINITY), kNothing);
  }
}

// Every kind of view drawn into every kind of target: what is drawn is where the scene is.
TEST(DepthMesh, IsTheSurface) {
  const AnalyticScene scene;
  for (const View& from : oneOfEachKind()) {
    const SourceView source = seen(scene, from, 1);
    const ViewProjector projector(from.geometry);
    for (const View& to : oneOfEachKind()) {
      const ViewProjector target(to.geometry);
      RangeBuffer buffer(target);
      drawDepth(projector, source.depth, nullptr, buffer);
      int drawn = 0, wrong = 0;
      for (int y = 0; y < target.size().height; ++y) {
        for (int x = 0; x < target.size().width; ++x) {
          const double range = buffer.range(x, y);
          if (range == kNothing) continue;
          ++drawn;
          const auto hit = scene.hit(rayThrough(to.geometry, {x + 0.5, y + 0.5}));
          const double apart =
              hit ? length(target.pointAt(x + 0.5, y + 0.5, range) - hit->point) : 9;
          // Squares at edges stand for a pixel, steep surfaces are known by a few.
          wrong += apart > 8 * projector.pixelWidth(3) ? 1 : 0;
        }
      }
      EXPECT_GT(drawn, 100) << from.name << " into " << to.name;
      EXPECT_LT(wrong, 0.12 * drawn) << from.name << " into " << to.name;
    }
  }
}

TEST(DepthMesh, CoversEveryPixelOfItsOwnView) {
  const AnalyticScene scene;
  for (const View& view : oneOfEachKind()) {
    const SourceView source = seen(scene, view);
    const ViewProjector projector(view.geometry);
    RangeBuffer buffer(projector);
    drawDepth(projector, source.depth, nullptr, buffer);
    for (int y = 0; y < source.depth.height(); ++y) {
      for (int x = 0; x < source.depth.width(); ++x) {
        const double expected = projector.rangeOf(source.depth.at(x, y, 0));
        ASSERT_EQ(buffer.range(x, y) < kNothing, expected < kNothing)
            << view.name << " " << x << "," << y;
        if (expected < kNothing) {
          ASSERT_NEAR(buffer.range(x, y), expected, 1e-6) << view.name << " " << x << "," << y;
        }
      }
    }
  }
}

TEST(DepthMesh, BacksAreNotSeen) {
  const AnalyticScene scene;
  const View front{"front", cameraAt({0, 0, 3}, {0, 0, 0}, 64)};
  const View behind{"behind", cameraAt({0, 0, -3}, {0, 0, 0}, 64)};
  const SourceView source = seen(scene, front);
  const ViewProjector projector(front.geometry), target(behind.geometry);
  RangeBuffer buffer(target);
  drawDepth(projector, source.depth, nullptr, buffer);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) EXPECT_EQ(buffer.range(x, y), kNothing);
  }
}

}  // namespace
}  // namespace illum
