#include "build/frames.h"

#include <gtest/gtest.h>

#include <numbers>

namespace illum {
namespace {

const Direction kUp = Direction::fromVector({0, 1, 0});

View slabView(const std::string& name, const RigidTransform& frame, int u) {
  LightSlab slab;
  slab.name = name;
  slab.objectFromSlab = frame;
  slab.uCount = 3;
  slab.size = {8, 8};
  return {name + std::to_string(u), SlabView{slab, u, 0}};
}

TEST(Frames, ViewsThatAreTurnedAlikeShareOne) {
  RigidTransform turned = rotationAbout(kUp, 1), moved = turned;
  moved.translation = {3, 4, 5};
  // The same turn on another way: equal but for rounding.
  const RigidTransform again = rotationAbout(kUp, 0.25) * rotationAbout(kUp, 0.75);
  PinholeCamera camera;
  camera.objectFromCamera = turned;
  const std::vector<View> views{
      slabView("front", {}, 0),    slabView("side", turned, 0), slabView("front", {}, 1),
      slabView("moved", moved, 0), slabView("again", again, 0), {"camera", camera},
      {"panorama", Panorama{}},
  };
  const auto frames = framesOf(views);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].groups, (std::vector<int>{0, 2, 5, 6}))
      << "cameras see in the object's frame";
  EXPECT_EQ(frames[1].groups, (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(frameOfEachView(frames, views.size()), (std::vector<int>{0, 1, 0, 1, 1, 0, 0}));
  EXPECT_EQ(nameOf(frames[1], views), "side (3 views)");
}

TEST(Frames, EachSlabOfATurnHasItsOwn) {
  std::vector<View> views;
  for (int slab = 0; slab < 8; ++slab)
    for (int u = 0; u < 3; ++u)
      views.push_back(slabView("turn_" + std::to_string(slab),
                               rotationAbout(kUp, slab * std::numbers::pi / 4), u));
  const auto frames = framesOf(views);
  ASSERT_EQ(frames.size(), 8u);
  for (const TurnedFrame& frame : frames) EXPECT_EQ(frame.groups.size(), 3u);
}

TEST(Frames, LightsAreSeenFromTheFrame) {
  // Turned to the right by a quarter, its z is the object's x.
  const TurnedFrame frame{rotationAbout(kUp, std::numbers::pi / 2), {0}};
  const std::vector<DirectionalLight> lights{{Direction::fromVector({1, 0, 0}), {1, 2, 3}}};
  const auto turned = frame.turned(lights);
  EXPECT_NEAR(turned[0].toLight.z(), 1, 1e-12);
  EXPECT_EQ(turned[0].intensity, (LinearRgb{1, 2, 3}));
  EXPECT_EQ(TurnedFrame().turned(lights)[0].toLight, lights[0].toLight) << "to the last bit";
}

}  // namespace
}  // namespace illum
