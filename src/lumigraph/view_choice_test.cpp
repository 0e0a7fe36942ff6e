#include "lumigraph/view_choice.h"

#include <gmock/gmock.h>

#include "illum/error.h"

namespace illum {
namespace {

LightSlab slabCalled(const std::string& name, int uCount, int vCount) {
  LightSlab slab;
  slab.name = name;
  slab.uCount = uCount;
  slab.vCount = vCount;
  slab.size = {40, 30};
  return slab;
}

std::vector<View> viewsOf(const std::vector<LightSlab>& slabs) {
  std::vector<View> views;
  for (const LightSlab& slab : slabs) {
    for (int v = 0; v < slab.vCount; ++v) {
      for (int u = 0; u < slab.uCount; ++u)
        views.push_back(
            {slab.name + std::to_string(u) + "_" + std::to_string(v), SlabView{slab, u, v}});
    }
  }
  return views;
}

View cameraCalled(const std::string& name, Vector3 eye) {
  PinholeCamera camera;
  camera.objectFromCamera.translation = eye;
  camera.size = {40, 30};
  return {name, camera};
}

TEST(ViewChoice, TheMiddleOfAnOddGridIsAView) {
  const auto views = viewsOf({slabCalled("front", 3, 5)});
  const ViewChoice choice = middleView(views);
  EXPECT_EQ(choice.group, 2 * 3 + 1);
  EXPECT_EQ(choice.geometry, views[7].geometry);
}

TEST(ViewChoice, TheMiddleOfAnEvenGridLiesBetween) {
  const LightSlab slab = slabCalled("front", 2, 5);
  const ViewChoice choice = middleView(viewsOf({slab}));
  EXPECT_FALSE(choice.group);
  EXPECT_EQ(choice.geometry, ViewGeometry(pinholeOf(slab, 0.5, 0.5)));
}

TEST(ViewChoice, FractionsOfTheGrid) {
  const LightSlab slab = slabCalled("front", 4, 3);
  const auto views = viewsOf({slab});
  EXPECT_EQ(viewNamed(views, "0,0").group, 0);
  EXPECT_EQ(viewNamed(views, "1,1").group, 11);
  EXPECT_EQ(viewNamed(views, "0.333333,0.5").group, 4 + 1) << "a third as people write it";
  const ViewChoice between = viewNamed(views, "0.25,1");
  EXPECT_FALSE(between.group);
  EXPECT_EQ(between.geometry, ViewGeometry(pinholeOf(slab, 0.25, 1)));
  EXPECT_EQ(between.slab, slab);
}

TEST(ViewChoice, AViewThatIsMissingFromTheGridIsSynthesised) {
  auto views = viewsOf({slabCalled("front", 3, 3)});
  views.erase(views.begin() + 4);
  EXPECT_FALSE(viewNamed(views, "0.5,0.5").group);
  EXPECT_EQ(viewNamed(views, "0,1").group, 5);
}

TEST(ViewChoice, AnotherSlabByItsName) {
  const auto views = viewsOf({slabCalled("front", 2, 2), slabCalled("a:b", 3, 1)});
  EXPECT_EQ(viewNamed(views, "a:b:0.5,0").group, 4 + 1);
  EXPECT_EQ(viewNamed(views, "front:1,0").group, 1);
  EXPECT_EQ(viewNamed(views, "1,0").group, 1) << "the first without a name";
}

TEST(ViewChoice, ViewsByTheirNames) {
  const std::vector<View> views{cameraCalled("left", {-4, 0, 1}), cameraCalled("middle", {0, 0, 1}),
                                cameraCalled("right", {3, 0, 1})};
  EXPECT_EQ(viewNamed(views, "right").group, 2);
  EXPECT_EQ(middleView(views).group, 1);
  EXPECT_EQ(viewNamed(viewsOf({slabCalled("front", 2, 2)}), "front1_1").group, 3);
}

TEST(ViewChoice, WhatMeansNothingIsRefused) {
  const auto slabs = viewsOf({slabCalled("front", 2, 2)});
  const std::vector<View> cameras{cameraCalled("left", {})};
  for (const char* name : {"", "0", "0,0,0", "1.5,0", "-0.1,0", "0,nan", "back:0,0", "0;0", ":0,0"})
    EXPECT_THROW(viewNamed(slabs, name), Error) << name;
  for (const char* name : {"", "0,0", "Left", "left "})
    EXPECT_THROW(viewNamed(cameras, name), Error) << name;
  const std::vector<View> photograph{{"photograph", OrthographicView{{4, 3}}}};
  EXPECT_THROW(viewNamed(photograph, "photograph"), Error);
  EXPECT_EQ(middleView(photograph).group, 0);
}

}  // namespace
}  // namespace illum
