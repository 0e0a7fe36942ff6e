#include "scene/capture_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "illum/error.h"
#include "scene/builtin.h"
#include "scene/shapes.h"

namespace illum {
namespace {

Scene boxScene(Vector3 size) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes = {boxMesh(size)};
  return scene;
}

/// Every point of the scene is seen by every view, and the tightest one stays within the margin.
void expectAllSeen(const CaptureSetup& setup, const Scene& scene, double mostFree) {
  double left = 1, top = 1, right = 1, bottom = 1;  // free borders over the longer side
  for (const View& view : setup.views) {
    const Size size = sizeOf(view.geometry);
    const double longer = std::max(size.width, size.height);
    for (const TriangleMesh& mesh : scene.meshes) {
      for (const auto& p : mesh.positions) {
        const auto at = pixelOf(view.geometry, vectorOf(p));
        ASSERT_TRUE(at.has_value()) << view.name;
        left = std::min(left, at->x / longer);
        right = std::min(right, (size.width - at->x) / longer);
        top = std::min(top, at->y / longer);
        bottom = std::min(bottom, (size.height - at->y) / longer);
      }
    }
  }
  for (const double border : {left, right, top, bottom}) {
    EXPECT_GT(border, 0.005);
    EXPECT_LT(border, mostFree);
  }
}

TEST(SlabFraming, ShowsTheWholeSceneTightly) {
  for (const Vector3 size : {Vector3{1, 1, 1}, Vector3{3, 1, 0.5}, Vector3{0.2, 7, 2}}) {
    const Scene scene = boxScene(size);
    const CaptureSetup setup = captureSetup({}, scene);
    EXPECT_EQ(setup.views.size(), 25u);
    expectAllSeen(setup, scene, 0.1);
    const Size pixels = sizeOf(setup.views.front().geometry);
    EXPECT_EQ(std::max(pixels.width, pixels.height), 256);
    const LightSlab& slab = std::get<SlabView>(setup.views.front().geometry).slab;
    EXPECT_NEAR((slab.st.right - slab.st.left) / pixels.width,
                (slab.st.top - slab.st.bottom) / pixels.height, 1e-12)
        << "square pixels";
  }
}

TEST(SlabFraming, WindowStandsThroughTheMiddleOfTheScene) {
  Scene scene = boxScene({1, 2, 3});
  transform(scene.meshes[0], {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {5, 6, 7}});
  SlabPlan plan;
  plan.toward = {1, 0, 0};
  const CaptureSetup setup = captureSetup({{plan}, {}}, scene);
  const LightSlab& slab = std::get<SlabView>(setup.views.front().geometry).slab;
  EXPECT_NEAR(length(slab.objectFromSlab.translation - Vector3{5, 6, 7}), 0, 1e-6);
  EXPECT_NEAR(slab.objectFromSlab.vector({0, 0, 1}).x, 1, 1e-12);
  expectAllSeen(setup, scene, 0.1);
}

TEST(SlabFraming, ATurnGoesAroundToTheRight) {
  const Scene scene = boxScene({1, 2, 1.5});
  TurnPlan plan;
  plan.slabs = 4;
  plan.slab.uCount = 3, plan.slab.vCount = 2;
  const CaptureSetup setup = captureSetup({{plan}, {}}, scene);
  ASSERT_EQ(setup.views.size(), 24u);
  const auto slab = [&](std::size_t i) {
    return std::get<SlabView>(setup.views[6 * i].geometry).slab;
  };
  EXPECT_NEAR(slab(0).objectFromSlab.vector({0, 0, 1}).z, 1, 1e-12);
  EXPECT_NEAR(slab(1).objectFromSlab.vector({0, 0, 1}).x, 1, 1e-12);
  EXPECT_EQ(slab(1).st, slab(3).st);
  expectAllSeen(setup, scene, 0.2);
  // Joined: the right edge of one grid of view points is the left edge of the next.
  const Vector3 right = slab(0).objectFromSlab.point(slab(0).viewPoint(1, 0.5));
  const Vector3 left = slab(1).objectFromSlab.point(slab(1).viewPoint(0, 0.5));
  EXPECT_NEAR(length(right - left), 0, 1e-9);
}

TEST(SlabFraming, RefusesViewPointsInsideTheScene) {
  SlabPlan plan;
  plan.distance = 0.4;
  EXPECT_THROW(captureSetup({{plan}, {}}, boxScene({1, 1, 1})), Error);
}

TEST(CaptureSetup, CameraSeesTheWholeScene) {
  const Scene scene = boxScene({1, 2, 3});
  const CaptureSetup setup = captureSetup({{CameraPlan{}}, {}}, scene);
  expectAllSeen(setup, scene, 0.5);
}

TEST(CaptureSetup, LightDiscsHaveHalfTheirSpacing) {
  CapturePlan plan;
  plan.lights.lights = PolarGrid{20, 20};
  const CaptureSetup setup = captureSetup(plan, boxScene({1, 1, 1}));
  EXPECT_EQ(setup.lights.size(), 400u);
  EXPECT_NEAR(setup.lightRadiusRadians, M_PI / 80, 1e-9);
  plan.lights.radiusRadians = 0;
  EXPECT_EQ(captureSetup(plan, boxScene({1, 1, 1})).lightRadiusRadians, 0);
}

TEST(CaptureSetup, OverridesChangeCountsAndSizes) {
  CaptureOverrides overrides;
  overrides.uCount = 3, overrides.vCount = 1, overrides.longerSide = 40, overrides.lights = 7;
  overrides.samplesPerPixel = 2, overrides.bounces = 0;
  for (const BuiltinScene& scene : builtinScenes()) {
    const CaptureSetup setup = builtinScene(scene.name, overrides).setup;
    const Size size = sizeOf(setup.views.front().geometry);
    EXPECT_EQ(std::max(size.width, size.height), 40) << scene.name;
    EXPECT_EQ(setup.lights.size(), 7u);
    EXPECT_EQ(setup.samplesPerPixel, 2);
    EXPECT_EQ(setup.bounces, 0);
    if (std::holds_alternative<SlabView>(setup.views.front().geometry)) {
      EXPECT_EQ(setup.views.size(), 3u) << scene.name;
    }
  }
}

TEST(CaptureSetup, RefusesAnEmptySceneAndNoViews) {
  EXPECT_THROW(captureSetup({}, Scene{}), Error);
  CapturePlan plan;
  plan.views.clear();
  EXPECT_THROW(captureSetup(plan, boxScene({1, 1, 1})), Error);
}

TEST(Builtin, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    builtinScene("kettle");
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::Usage);
    EXPECT_NE(std::string(error.what()).find("builtin:teapot"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace illum
