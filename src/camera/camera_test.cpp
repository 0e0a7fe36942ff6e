#include "illum/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace illum {
namespace {

constexpr double kPi = std::numbers::pi;

RigidTransform someFrame() {
  RigidTransform frame = rotationAbout(Direction::fromVector({1, 2, -0.5}), 0.8);
  frame.translation = {0.3, -1.2, 2.5};
  return frame;
}

LightSlab someSlab() {
  LightSlab slab;
  slab.name = "front";
  slab.objectFromSlab = someFrame();
  slab.distance = 3;
  slab.uv = {-1.5, -1, 2, 1.25};
  slab.uCount = 5;
  slab.vCount = 3;
  slab.st = {-1, -0.75, 1.5, 0.5};
  slab.size = {250, 125};
  return slab;
}

std::vector<View> someViews() {
  PinholeCamera pinhole;
  pinhole.objectFromCamera = lookAt({2, 1, 4}, {0.1, 0.2, 0}, {0, 1, 0});
  pinhole.focalX = 300;
  pinhole.focalY = 280;
  pinhole.centre = {101.5, 77};
  pinhole.size = {200, 160};
  Panorama around;
  around.objectFromCamera = someFrame();
  around.size = {360, 180};
  Panorama cylinder = around;
  cylinder.projection = Panorama::Projection::Cylindrical;
  cylinder.extent = {-0.5 * kPi, -0.75, 1.25 * kPi, 1};
  cylinder.size = {400, 120};
  return {{"photograph", OrthographicView{{320, 200}}},
          {"slab", SlabView{someSlab(), 4, 0}},
          {"pinhole", pinhole},
          {"equirectangular", around},
          {"cylindrical", cylinder}};
}

TEST(Camera, PointsAreSeenWhereTheirRaysStart) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const View& view : someViews()) {
    const Size size = sizeOf(view.geometry);
    for (int i = 0; i < 100; ++i) {
      const PixelPosition position{unit(random) * size.width, unit(random) * size.height};
      const Ray ray = rayThrough(view.geometry, position);
      EXPECT_NEAR(length(ray.direction), 1, 1e-12);
      const Vector3 point = ray.origin + (0.5 + 4 * unit(random)) * ray.direction;
      const auto seen = pixelOf(view.geometry, point);
      ASSERT_TRUE(seen) << view.name;
      EXPECT_NEAR(seen->x, position.x, 1e-8 * size.width) << view.name;
      EXPECT_NEAR(seen->y, position.y, 1e-8 * size.width) << view.name;
    }
  }
}

TEST(Camera, DepthAndPositionDetermineThePoint) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const View& view : someViews()) {
    const Size size = sizeOf(view.geometry);
    for (int i = 0; i < 100; ++i) {
      const PixelPosition position{unit(random) * size.width, unit(random) * size.height};
      const Ray ray = rayThrough(view.geometry, position);
      const Vector3 point = ray.origin + (0.5 + 4 * unit(random)) * ray.direction;
      const Vector3 back = pointAt(view.geometry, position, depthOf(view.geometry, point));
      EXPECT_NEAR(length(back - point), 0, 1e-9) << view.name;
    }
  }
}

TEST(Camera, RowsGoDownAndColumnsRight) {
  for (const View& view : someViews()) {
    const Size size = sizeOf(view.geometry);
    const PixelPosition centre{0.5 * size.width, 0.5 * size.height};
    const Ray middle = rayThrough(view.geometry, centre);
    const Ray right = rayThrough(view.geometry, {centre.x + 1, centre.y});
    const Ray below = rayThrough(view.geometry, {centre.x, centre.y + 1});
    const auto at = [](const Ray& ray) { return ray.origin + 2.0 * ray.direction; };
    const Vector3 x = at(right) - at(middle), y = at(middle) - at(below);
    // x right, y up, and what is left over points to the viewer: against the ray.
    EXPECT_LT(dot(cross(x, y), middle.direction), 0) << view.name;
  }
}

TEST(Camera, PhotographsAreCentredAndHalfTheirLongerSideIsOne) {
  const ViewGeometry view = OrthographicView{{200, 100}};
  const Vector3 corner = pointAt(view, {0, 0}, 0);
  EXPECT_NEAR(length(corner - Vector3{-1, 0.5, 0}), 0, 1e-12);
  EXPECT_EQ(depthOf(view, {0.3, 0.2, -0.7}), -0.7);
}

TEST(Slab, ViewPointsLieOnTheGridAndSeeTheWindow) {
  const LightSlab slab = someSlab();
  EXPECT_EQ(slab.viewPoint(0, 0), (Vector3{-1.5, -1, 3}));
  EXPECT_EQ(slab.viewPoint(1, 1), (Vector3{2, 1.25, 3}));
  for (int v = 0; v < slab.vCount; ++v) {
    for (int u = 0; u < slab.uCount; ++u) {
      // The window's corners are the picture's corners from every view point.
      const ViewGeometry view = SlabView{slab, u, v};
      const Vector3 topLeft = slab.objectFromSlab.point({slab.st.left, slab.st.top, 0});
      const auto seen = pixelOf(view, topLeft);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(seen->x, 0, 1e-9);
      EXPECT_NEAR(seen->y, 0, 1e-9);
      const Vector3 bottomRight = slab.objectFromSlab.point({slab.st.right, slab.st.bottom, 0});
      EXPECT_NEAR(pixelOf(view, bottomRight)->x, 250, 1e-9);
      EXPECT_NEAR(pixelOf(view, bottomRight)->y, 125, 1e-9);
    }
  }
}

TEST(Slab, ASingleViewPointStandsInTheMiddle) {
  LightSlab slab = someSlab();
  slab.uCount = 1;
  EXPECT_EQ(slab.viewPoint(0, 0).x, 0.25);
  EXPECT_EQ(slab.viewPoint(1, 0).x, 0.25);
}

TEST(Slab, NothingBehindTheEyeIsSeen) {
  const LightSlab slab = someSlab();
  const ViewGeometry view = SlabView{slab, 2, 1};
  EXPECT_FALSE(pixelOf(view, slab.objectFromSlab.point({0, 0, 3.5})));
  EXPECT_FALSE(pixelOf(view, slab.objectFromSlab.point({0, 0, 3})));
  EXPECT_TRUE(pixelOf(view, slab.objectFromSlab.point({0, 0, 2.9})));
}

TEST(Slab, ItsPinholeCamerasSeeTheSame) {
  const LightSlab slab = someSlab();
  for (int v = 0; v < slab.vCount; ++v) {
    for (int u = 0; u < slab.uCount; ++u) {
      const ViewGeometry asSlab = SlabView{slab, u, v};
      const ViewGeometry asPinhole = pinholeOf(slab, u / 4.0, v / 2.0);
      for (const PixelPosition p : {PixelPosition{0, 0}, {250, 0}, {33.5, 99.25}}) {
        const Ray a = rayThrough(asSlab, p), b = rayThrough(asPinhole, p);
        EXPECT_NEAR(length(a.origin - b.origin), 0, 1e-12);
        EXPECT_NEAR(length(a.direction - b.direction), 0, 1e-12);
      }
    }
  }
}

TEST(Slab, IsTheSlabOfItsPinholeCameras) {
  const LightSlab slab = someSlab();
  const LightSlab back = slabOf(pinholeOf(slab, 0.25, 0.5), slab.distance);
  const ViewGeometry before = SlabView{slab, 1, 1}, after = SlabView{back, 0, 0};
  for (const PixelPosition p : {PixelPosition{0, 0}, {250, 125}, {10, 120}}) {
    const Ray a = rayThrough(before, p), b = rayThrough(after, p);
    EXPECT_NEAR(length(a.origin - b.origin), 0, 1e-12);
    EXPECT_NEAR(length(a.direction - b.direction), 0, 1e-12);
  }
}

TEST(Slab, MovesAsARigidThing) {
  LightSlab slab = someSlab();
  const RigidTransform move = rotationAbout(Direction::fromVector({0, 1, 1}), -2.1);
  LightSlab moved = slab;
  moved.objectFromSlab = move * slab.objectFromSlab;
  const Vector3 point{0.2, 0.1, -0.4};
  const ViewGeometry before = SlabView{slab, 0, 2}, after = SlabView{moved, 0, 2};
  EXPECT_NEAR(pixelOf(before, point)->x, pixelOf(after, move.point(point))->x, 1e-9);
  EXPECT_NEAR(pixelOf(before, point)->y, pixelOf(after, move.point(point))->y, 1e-9);
  EXPECT_NEAR(depthOf(before, point), depthOf(after, move.point(point)), 1e-12);
}

TEST(Pinhole, LooksAtItsTarget) {
  PinholeCamera camera;
  camera.objectFromCamera = lookAt({2, 1, 4}, {0.1, 0.2, 0}, {0, 1, 0});
  camera.focalX = camera.focalY = 100;
  camera.centre = {50, 40};
  camera.size = {100, 80};
  const ViewGeometry view = camera;
  EXPECT_NEAR(pixelOf(view, {0.1, 0.2, 0})->x, 50, 1e-12);
  EXPECT_NEAR(pixelOf(view, {0.1, 0.2, 0})->y, 40, 1e-12);
  EXPECT_LT(pixelOf(view, {0.1, 0.4, 0})->y, 40) << "up is up";
  EXPECT_NEAR(depthOf(view, {0.1, 0.2, 0}), length(Vector3{1.9, 0.8, 4}), 1e-12);
  EXPECT_FALSE(pixelOf(view, {4, 2, 8}));
}

TEST(Panorama, LooksToMinusZWithXOnTheRight) {
  Panorama around;
  around.size = {400, 200};
  const ViewGeometry view = around;
  const auto expectSeen = [&](Vector3 point, double x, double y) {
    const auto seen = pixelOf(view, point);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, x, 1e-9);
    EXPECT_NEAR(seen->y, y, 1e-9);
  };
  expectSeen({0, 0, -5}, 200, 100);
  expectSeen({5, 0, 0}, 300, 100);
  expectSeen({-5, 0, 0}, 100, 100);
  expectSeen({3, 3, 0}, 300, 50);
  EXPECT_FALSE(pixelOf(view, {0, 0, 0}));
}

TEST(Panorama, ACylinderIsEvenInHeight) {
  Panorama cylinder;
  cylinder.projection = Panorama::Projection::Cylindrical;
  cylinder.extent = {-kPi, -1, kPi, 1};
  cylinder.size = {400, 100};
  const ViewGeometry view = cylinder;
  EXPECT_NEAR(pixelOf(view, {0, 0.5, -1})->y, 25, 1e-9);
  EXPECT_NEAR(pixelOf(view, {0, 1, -2})->y, 25, 1e-9);
  EXPECT_NEAR(pixelOf(view, {0, -1, -1})->y, 100, 1e-9);
  EXPECT_FALSE(pixelOf(view, {0, 1, 0})) << "no height reaches the pole";
}

}  // namespace
}  // namespace illum
