// docs/conventions.md, "Views".
#include "expect.h"
#include "illum/camera.h"

#include <cmath>

using illum::LightSlab;
using illum::Panorama;
using illum::PinholeCamera;
using illum::PixelPosition;
using illum::RigidTransform;
using illum::SlabView;
using illum::Vector3;
using illum::ViewGeometry;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Where the view point (u, v) of a slab sees a point of the slab's own frame, in the window.
Vector3 throughWindow(Vector3 viewPoint, Vector3 point) {
  const double share = viewPoint.z / (viewPoint.z - point.z);
  return viewPoint + share * (point - viewPoint);
}

}  // namespace

int main() {
  LightSlab slab;
  slab.distance = 4;
  slab.uv = {-1, -1, 1, 1};
  slab.uCount = slab.vCount = 5;
  slab.st = {-2, -1, 2, 1};
  slab.size = {400, 200};
  const ViewGeometry view = SlabView{slab, /*u=*/3, /*v=*/2};

  expect(slab.viewPoint(0, 0) == Vector3{-1, -1, 4}, "u = v = 0 is the lower left view point");
  expect(slab.viewPoint(0.75, 0.5) == Vector3{0.5, 0, 4}, "column 3 of 5 has u = 3/4");

  const Vector3 point{1, 0.5, -4};
  const Vector3 inWindow = throughWindow(slab.viewPoint(0.75, 0.5), point);
  const PixelPosition seen = *pixelOf(view, point);
  expectNear(seen.x, (inWindow.x - slab.st.left) / 4 * 400, "columns go right");
  expectNear(seen.y, (slab.st.top - inWindow.y) / 2 * 200, "rows go down from the window's top");
  expectNear(depthOf(view, point), -4, "depth is z of the slab's frame");

  PinholeCamera camera;
  camera.objectFromCamera = illum::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  camera.focalX = camera.focalY = 100;
  camera.centre = {50, 40};
  camera.size = {100, 80};
  const Vector3 above{0.5, 1, 0};
  expectNear(pixelOf(camera, above)->x, 50 + 100 * 0.5 / 5,
             "right of the axis, right of the centre");
  expectNear(pixelOf(camera, above)->y, 40 - 100 * 1.0 / 5, "above the axis, above the centre");
  expectNear(depthOf(camera, above), 5, "depth is the distance along the optical axis");

  Panorama panorama;
  panorama.size = {400, 200};
  expectNear(pixelOf(panorama, {0, 0, -1})->x, 200, "the picture's centre looks along -z");
  expectNear(pixelOf(panorama, {1, 0, 0})->x, 300, "u increases toward +x");
  expectNear(pixelOf(panorama, {0, 1, -1})->y, 50, "y is up: 45 degrees, a quarter of the height");
  expectNear(depthOf(panorama, {3, 0, 4}), 5, "depth is the distance from the view point");

  const RigidTransform turn =
      illum::rotationAbout(illum::Direction::fromVector({0, 1, 0}), kPi / 2);
  slab.objectFromSlab = turn;
  expectNear(rayThrough(SlabView{slab, 2, 2}, {200, 100}).direction.x, -1,
             "a slab turned by 90 degrees about y looks along -x");
}
