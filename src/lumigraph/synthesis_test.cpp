#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "illum/error.h"
#include "illum/lumigraph.h"
#include "lumigraph/analytic_scene_for_test.h"

namespace illum {
namespace {

constexpr int kPixels = 96;

class Slab : public ::testing::Test {
 protected:
  static const std::vector<SourceView>& views() {
    static const std::vector<SourceView> made = seenBySlab({}, testSlab(5, kPixels));
    return made;
  }
  static SynthesisedView synthesised(const ViewGeometry& target,
                                     const SynthesisOptions& options = {}) {
    const auto source = viewSource(views());
    return synthesise(*source, target, options);
  }
  static Picture truth(const ViewGeometry& target) { return seen({}, {"truth", target}).picture; }
};

SynthesisOptions plain() {
  SynthesisOptions options;
  options.useDepth = false;
  return options;
}

void expectNear(const Picture& found, const Picture& expected, float most, const char* what) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.samples().size(); ++i) {
    ASSERT_NEAR(found.samples()[i], expected.samples()[i], most) << what << ", sample " << i;
  }
}

TEST_F(Slab, AtASampledViewItIsThatView) {
  for (const int i : {0, 7, 12, 24}) {
    const SourceView& view = views()[static_cast<std::size_t>(i)];
    const SynthesisedView byDepth = synthesised(view.view.geometry);
    expectNear(byDepth.picture, view.picture, 1e-5F, "by depth");
    expectNear(synthesised(view.view.geometry, plain()).picture, view.picture, 1e-5F, "plain");
    for (std::size_t p = 0; p < view.depth.samples().size(); ++p) {
      if (std::isfinite(view.depth.samples()[p])) {
        ASSERT_NEAR(byDepth.depth.samples()[p], view.depth.samples()[p], 1e-5);
      }
    }
  }
}

// On the uv plane, behind it, before it, beside the axis; the same camera with and without depth.
TEST_F(Slab, IsNearTheTruthFromAnywhere) {
  const struct {
    const char* where;
    Vector3 eye;
    double least;
  } cases[] = {{"on the plane", {0.3, -0.2, 3}, 31},
               {"behind it", {0.2, 0.3, 4.5}, 29},
               {"before it", {-0.25, 0.1, 1.9}, 28}};
  for (const auto& c : cases) {
    const ViewGeometry camera = cameraAt(c.eye, {0, 0, 0}, kPixels, c.eye.z > 4 ? 2 : 1.0);
    const Picture expected = truth(camera);
    const double corrected = decibels(synthesised(camera).picture, expected);
    const double uncorrected = decibels(synthesised(camera, plain()).picture, expected);
    RecordProperty(std::string(c.where) + " corrected", std::to_string(corrected));
    EXPECT_GT(corrected, c.least) << c.where;
    EXPECT_GT(corrected, uncorrected + 4) << c.where;
  }
}

TEST_F(Slab, WhatWasNotSeenIsTransparent) {
  // From the side, all rays pass beside the grid of view points.
  for (const SynthesisOptions& options : {SynthesisOptions{}, plain()}) {
    const SynthesisedView side = synthesised(cameraAt({3, 0, 0.5}, {0, 0, 0}, 32), options);
    for (const float value : side.picture.samples()) ASSERT_EQ(value, 0);
    const SynthesisedView behind = synthesised(cameraAt({0, 0, -3}, {0, 0, 0}, 32), options);
    for (const float value : behind.picture.samples()) ASSERT_EQ(value, 0);
  }
}

TEST_F(Slab, CoverageIsThatOfTheTruth) {
  const ViewGeometry camera = cameraAt({0.3, -0.2, 3}, {0, 0, 0}, kPixels, 1.0);
  const Picture expected = truth(camera), found = synthesised(camera).picture;
  int wrong = 0;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      wrong += std::abs(expected.at(x, y, 3) - found.at(x, y, 3)) > 0.5 ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, kPixels * kPixels / 200);
}

TEST_F(Slab, PlainInterpolationIsExactOnTheFocalPlane) {
  AnalyticScene wall;
  wall.radius = 0;
  const std::vector<SourceView> flat = seenBySlab(wall, testSlab(3, kPixels));
  const auto source = viewSource(flat);
  SynthesisOptions options;
  options.focus = Plane{{0, 0, wall.wallZ}, {0, 0, 1}};
  const ViewGeometry camera = cameraAt({0.33, 0.21, 3}, {0, 0, -0.6}, kPixels);
  const double sharp =
      decibels(synthesise(*source, camera, options).picture, seen(wall, {"", camera}).picture);
  options.focus = Plane{{0, 0, 0.3}, {0, 0, 1}};
  const double blurred =
      decibels(synthesise(*source, camera, options).picture, seen(wall, {"", camera}).picture);
  EXPECT_GT(sharp, 30);
  EXPECT_LT(blurred, 20);
}

TEST_F(Slab, AnApertureBlursWhatIsNotInFocus) {
  SynthesisOptions options;
  options.focus = Plane{{0, 0, -0.6}, {0, 0, 1}};
  options.apertureRadius = 0.6;
  const ViewGeometry camera = cameraAt({0, 0, 3}, {0, 0, 0}, kPixels);
  const Picture wide = synthesised(camera, options).picture;
  const Picture expected = truth(camera);
  // The wall left of the sphere is sharp, the sphere's middle is not.
  double wall = 0, sphere = 0;
  for (int y = 40; y < 56; ++y) {
    for (int x = 0; x < 8; ++x) {
      wall += std::abs(wide.at(12 + x, y, 0) - expected.at(12 + x, y, 0));
      sphere += std::abs(wide.at(44 + x, y, 0) - expected.at(44 + x, y, 0));
    }
  }
  EXPECT_LT(3 * wall, sphere);
}

TEST_F(Slab, TheEyeMayBeBetweenTheThings) {
  // Through the window, before the wall, past the sphere: only the wall is ahead.
  const ViewGeometry camera = cameraAt({0, 0, -0.1}, {0, 0, -1}, 48, 1.5);
  const Picture found = synthesised(camera).picture;
  // No view saw the wall behind the sphere's middle from there: it stays open, not smeared.
  EXPECT_LT(found.at(24, 24, 3), 1);
  const ViewGeometry beside = cameraAt({0.6, 0.1, -0.1}, {0.62, 0.1, -1}, 48, 7);
  const Picture expected = truth(beside);
  EXPECT_GT(decibels(synthesised(beside).picture, expected), 24);
}

TEST_F(Slab, IsTheSameOnAnyNumberOfThreads) {
  const ViewGeometry camera = cameraAt({0.2, 0.3, 4}, {0, 0, 0}, kPixels);
  const SynthesisedView many = synthesised(camera);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SynthesisedView alone = synthesised(camera);
  EXPECT_EQ(many.picture, alone.picture);
  EXPECT_EQ(many.depth, alone.depth);
}

TEST_F(Slab, MovesAsARigidThing) {
  RigidTransform move = rotationAbout(Direction::fromVector({0.3, 1, 0.2}), 1.1);
  move.translation = {3, -2, 1};
  std::vector<SourceView> moved = views();
  for (SourceView& view : moved) {
    LightSlab& slab = std::get<SlabView>(view.view.geometry).slab;
    slab.objectFromSlab = move * slab.objectFromSlab;
  }
  PinholeCamera camera = cameraAt({0.3, 0.1, 4}, {0, 0, 0}, 48);
  const Picture before = synthesised(camera).picture;
  camera.objectFromCamera = move * camera.objectFromCamera;
  const Picture after = synthesise(*viewSource(moved), camera).picture;
  EXPECT_GT(decibels(before, after), 60);
}

// Outlines of one view stand before what another one sees. What is covered in part there must not
// make holes.
TEST(CoarseSlab, OutlinesOfItsViewsMakeNoHolesInThings) {
  AnalyticScene scene;
  scene.radius = 0;
  std::vector<SourceView> views = seenBySlab(scene, testSlab(2, kPixels));
  SourceView& outlined = views.front();
  for (int y = 40; y < 56; ++y) {
    for (int c = 0; c < 4; ++c) outlined.picture.at(48, y, c) *= 0.1F;
    outlined.depth.at(48, y, 0) += 0.3F;
  }
  const PinholeCamera target = cameraAt({-0.4, -0.4, 3}, {0, 0, 0}, kPixels);
  const SynthesisedView found = synthesise(*viewSource(views), target);
  for (int y = 24; y < 72; ++y) {
    for (int x = 24; x < 72; ++x) ASSERT_GT(found.picture.at(x, y, 3), 0.8F) << x << "," << y;
  }
}

// Beyond the window's edge, the view points around a ray see nothing of what others see through it.
TEST(Slabs, SeeBesideTheWindowWhatAnyOfTheirViewsDoes) {
  AnalyticScene scene;
  scene.wallHalf = 4;
  for (const int count : {5, 17}) {
    LightSlab slab = testSlab(count, kPixels);
    slab.st = {-0.8, -0.8, 0.8, 0.8};
    // Near the grid's corner; the window fills half of the picture.
    const ViewGeometry camera = cameraAt({0.72, 0.7, 3}, {0, 0, 0}, kPixels, 1.6);
    const Picture found = synthesise(*viewSource(seenBySlab(scene, slab)), camera).picture;
    const Picture truth = seen(scene, {"", camera}).picture;
    int covered = 0;
    double squares = 0;
    for (std::size_t i = 0; i < found.size().pixels(); ++i) {
      const float* rgba = &found.samples()[4 * i];
      if (rgba[3] < 0.99F) continue;
      ++covered;
      for (std::size_t c = 0; c < 3; ++c)
        squares += std::pow(rgba[c] - truth.samples()[4 * i + c], 2) / 3;
    }
    EXPECT_GT(covered, 0.77 * kPixels * kPixels) << count;
    EXPECT_GT(-10 * std::log10(squares / covered), 28) << count;
  }
}

TEST(Slabs, MeetWithoutASeam) {
  // Two slabs at right angles, view points meeting in the edge between them.
  LightSlab front = testSlab(5, kPixels), right = front;
  front.distance = right.distance = 3;
  front.uv = right.uv = {-3, -0.8, 3, 0.8};
  front.st = right.st = {-1.6, -1.1, 1.6, 1.1};
  front.uCount = right.uCount = 9;
  front.vCount = right.vCount = 3;
  front.size = right.size = {140, kPixels};
  right.name = "right";
  right.objectFromSlab = rotationAbout(Direction::fromVector({0, 1, 0}), std::acos(0.0));
  AnalyticScene ball;
  ball.wallHalf = 0;
  std::vector<SourceView> views = seenBySlab(ball, front);
  for (SourceView& view : seenBySlab(ball, right)) views.push_back(std::move(view));
  const auto source = viewSource(views);
  double least = 99;
  for (const double degrees : {35.0, 44.0, 45.0, 46.0, 55.0}) {
    const double turn = degrees * std::acos(-1.0) / 180;
    const ViewGeometry camera =
        cameraAt({5.5 * std::sin(turn), 0, 5.5 * std::cos(turn)}, {0, 0, 0}, kPixels, 3);
    const double quality =
        decibels(synthesise(*source, camera).picture, seen(ball, {"", camera}).picture);
    least = std::min(least, quality);
  }
  EXPECT_GT(least, 26);
}

TEST_F(Slab, IsResampledFinerAndCoarser) {
  const LightSlab slab = testSlab(5, kPixels);
  std::vector<SourceView> finer;
  resampleSlab(*viewSource(views()), slab, 9, 5, {},
               [&](SourceView&& view) { finer.push_back(std::move(view)); });
  ASSERT_EQ(finer.size(), 45U);
  for (const SourceView& view : finer) {
    const auto& at = std::get<SlabView>(view.view.geometry);
    if (at.v != 2) continue;
    if (at.u % 2 == 0) {
      expectNear(view.picture, views()[static_cast<std::size_t>(10 + at.u / 2)].picture, 1e-5F,
                 "a view point of the first grid");
    } else {
      EXPECT_GT(decibels(view.picture, truth(view.view.geometry)), 29) << at.u;
    }
  }
  // And back: every second column is what it was.
  std::vector<SourceView> back;
  resampleSlab(*viewSource(finer), std::get<SlabView>(finer.front().view.geometry).slab, 5, 5, {},
               [&](SourceView&& view) { back.push_back(std::move(view)); });
  for (std::size_t i = 0; i < back.size(); ++i) {
    expectNear(back[i].picture, views()[i].picture, 2e-5F, "back again");
  }
}

TEST_F(Slab, PlanesOfAnyNumberAreInterpolatedAlike) {
  std::vector<SourceView> planes = views();
  for (SourceView& view : planes) {
    Picture wide(view.picture.size(), 7);
    for (std::size_t i = 0; i < wide.size().pixels(); ++i) {
      const float* rgba = &view.picture.samples()[4 * i];
      float* out = &wide.samples()[7 * i];
      // -2 r, 3 g, b, r + g, r, a
      const float values[7] = {-2 * rgba[0], 3 * rgba[1], rgba[2], rgba[0] + rgba[1],
                               rgba[0],      0,           rgba[3]};
      std::copy_n(values, 7, out);
    }
    view.picture = std::move(wide);
  }
  const ViewGeometry camera = cameraAt({0.3, -0.2, 3}, {0, 0, 0}, 48, 1.0);
  const Picture colours = synthesised(camera).picture;
  const Picture found = synthesise(*viewSource(planes), camera).picture;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      ASSERT_NEAR(found.at(x, y, 0), -2 * colours.at(x, y, 0), 1e-5);
      ASSERT_NEAR(found.at(x, y, 3), colours.at(x, y, 0) + colours.at(x, y, 1), 1e-5);
      ASSERT_EQ(found.at(x, y, 5), 0);
      ASSERT_EQ(found.at(x, y, 6), colours.at(x, y, 3));
    }
  }
}

std::vector<SourceView> seenAround(const AnalyticScene& scene, int count) {
  std::vector<SourceView> views;
  for (int i = 0; i < count; ++i) {
    const double angle = -0.5 + 1.0 * i / (count - 1);
    const Vector3 eye{3 * std::sin(angle), 0.4 * std::cos(7 * angle), 3 * std::cos(angle)};
    views.push_back(
        seen(scene, {"view" + std::to_string(i), cameraAt(eye, {0, 0, -0.2}, kPixels, 1.6)}));
  }
  return views;
}

TEST(FreeViews, AreThemselves) {
  const std::vector<SourceView> views = seenAround({}, 7);
  const auto source = viewSource(views);
  for (const SourceView& view : views) {
    expectNear(synthesise(*source, view.view.geometry).picture, view.picture, 1e-4F, "by depth");
    expectNear(synthesise(*source, view.view.geometry, plain()).picture, view.picture, 1e-4F,
               "by a plane");
  }
}

TEST(FreeViews, AreNearTheTruthBetweenEachOther) {
  const AnalyticScene scene;
  const std::vector<SourceView> views = seenAround(scene, 7);
  const auto source = viewSource(views);
  const ViewGeometry camera = cameraAt({-0.74, 0.2, 2.9}, {0, 0, -0.1}, kPixels);
  const Picture expected = seen(scene, {"", camera}).picture;
  const double corrected = decibels(synthesise(*source, camera).picture, expected);
  EXPECT_GT(corrected, 28);
  EXPECT_GT(corrected, 4 + decibels(synthesise(*source, camera, plain()).picture, expected));
}

// Photographs are covered everywhere; their depth tells of the sphere and the wall alone.
TEST(FreeViews, ABackdropIsSeenWhereNothingElseIs) {
  const AnalyticScene scene;
  std::vector<SourceView> views = seenAround(scene, 7);
  const auto fill = [](Picture& picture) {
    for (std::size_t i = 0; i < picture.samples().size(); i += 4) {
      float* rgba = &picture.samples()[i];
      rgba[1] += 0.5F * (1 - rgba[3]);
      rgba[3] = 1;
    }
  };
  for (SourceView& view : views) fill(view.picture);
  const auto source = viewSource(views);
  EXPECT_TRUE(source->hasBackdrop());
  const ViewGeometry camera = cameraAt({-0.74, 0.2, 2.9}, {0, 0, -0.2}, kPixels, 2.2);
  Picture expected = seen(scene, {"", camera}).picture;
  fill(expected);
  EXPECT_GT(decibels(synthesise(*source, camera).picture, expected), 27);
  expectNear(synthesise(*source, views[3].view.geometry).picture, views[3].picture, 1e-4F,
             "itself");
}

// Some of a slab's view points beside free cameras and a panorama.
TEST(FreeViews, TakeASlabForFreeCameras) {
  const AnalyticScene scene;
  std::vector<SourceView> views = seenAround(scene, 5);
  for (const SourceView& view : seenBySlab(scene, testSlab(3, kPixels))) views.push_back(view);
  Panorama around;
  around.size = {240, 120};
  around.objectFromCamera.translation = {0.1, 0, 2.6};
  views.push_back(seen(scene, {"around", around}, 2));
  for (const int first : {0, 5}) {  // a free camera first, or a slab's view point
    std::rotate(views.begin(), views.begin() + first, views.end());
    const auto source = viewSource(views);
    for (std::size_t i = 0; i + 1 < views.size(); ++i)
      expectNear(synthesise(*source, views[i].view.geometry).picture, views[i].picture, 1e-4F,
                 views[i].view.name.c_str());
    const ViewGeometry camera = cameraAt({-0.3, 0.2, 2.9}, {0, 0, -0.1}, kPixels);
    const Picture expected = seen(scene, {"", camera}).picture;
    EXPECT_GT(decibels(synthesise(*source, camera).picture, expected), 28);
  }
}

TEST(Panoramas, LookAround) {
  // From inside a box-less scene: the sphere and the wall seen from between them and the viewer.
  const AnalyticScene scene;
  Panorama around;
  around.size = {720, 360};
  around.objectFromCamera.translation = {0, 0.1, 1.2};
  std::vector<SourceView> views{seen(scene, {"around", around}, 2)};
  for (const bool withDepth : {true, false}) {
    if (!withDepth) views.front().depth = {};
    const auto source = viewSource(views);
    const ViewGeometry camera = cameraAt({0, 0.1, 1.2}, {0.1, 0, 0}, 80, 1);
    const Picture expected = seen(scene, {"", camera}).picture;
    EXPECT_GT(decibels(synthesise(*source, camera).picture, expected), 28) << withDepth;
    const ViewGeometry away = cameraAt({0, 0.1, 1.2}, {0.1, 0, 3}, 32, 1);
    const Picture unseen = synthesise(*source, away).picture;
    for (const float value : unseen.samples()) EXPECT_EQ(value, 0);
  }
}

TEST(Panoramas, AreSynthesisedToo) {
  const AnalyticScene scene;
  const std::vector<SourceView> views = seenBySlab(scene, testSlab(5, kPixels));
  Panorama around;
  around.size = {240, 120};
  around.objectFromCamera.translation = {0.1, 0, 2.6};
  around.extent = {-0.4, -0.3, 0.4, 0.3};
  const double quality =
      decibels(synthesise(*viewSource(views), around).picture, seen(scene, {"", around}).picture);
  EXPECT_GT(quality, 26);
}

TEST(Sources, AreChecked) {
  std::vector<SourceView> views = seenAround({}, 2);
  EXPECT_THROW(viewSource({}), Error);
  std::vector<SourceView> odd = views;
  odd[1].picture = Picture({3, 3}, 4);
  EXPECT_THROW(viewSource(odd), Error);
  odd = views;
  odd[1].depth = {};
  EXPECT_THROW(viewSource(odd), Error);
  const auto good = viewSource(views);
  SynthesisOptions options;
  options.blendedViews = 0;
  EXPECT_THROW(synthesise(*good, views[0].view.geometry, options), Error);
  options = {};
  options.apertureRadius = -1;
  EXPECT_THROW(synthesise(*good, views[0].view.geometry, options), Error);
  options = {};
  options.focus = Plane{{0, 0, 0}, {0, 0, 0}};
  EXPECT_THROW(synthesise(*good, views[0].view.geometry, options), Error);
}

}  // namespace
}  // namespace illum
