#include "convert/view_plan.h"

#include <gmock/gmock.h>

#include "illum/error.h"

namespace illum {
namespace {

Manifest manifestOf(int uCount, int vCount) {
  LightSlab slab;
  slab.name = "front";
  slab.uCount = uCount;
  slab.vCount = vCount;
  slab.size = {8, 6};
  Manifest manifest;
  manifest.bases.resize(2);
  for (int v = 0; v < vCount; ++v) {
    for (int u = 0; u < uCount; ++u)
      manifest.groups.push_back(
          {{std::to_string(u) + std::to_string(v), SlabView{slab, u, v}}, 1, DepthRange{0, 1, 10}});
  }
  return manifest;
}

std::vector<std::optional<int>> storedOf(const std::vector<PlannedView>& views) {
  std::vector<std::optional<int>> stored;
  for (const PlannedView& view : views) stored.push_back(view.stored);
  return stored;
}

TEST(ViewPlan, TheSameGridIsTheStoredOne) {
  const Manifest manifest = manifestOf(3, 2);
  const auto views = viewsOnGrid(manifest, 3, 2);
  EXPECT_THAT(storedOf(views), testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(views[4].entry.view.geometry, manifest.groups[4].view.geometry);
}

TEST(ViewPlan, AFinerGridKeepsEveryOther) {
  const auto views = viewsOnGrid(manifestOf(2, 2), 3, 3);
  const std::optional<int> made;
  EXPECT_THAT(storedOf(views), testing::ElementsAre(0, made, 1, made, made, made, 2, made, 3));
  EXPECT_THAT(views[1].sources, testing::ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(views[1].entry.basis, 1);
  EXPECT_EQ(views[5].entry.view.name, "front_u02_v01");
}

TEST(ViewPlan, ACoarserGridDropsOthers) {
  EXPECT_THAT(storedOf(viewsOnGrid(manifestOf(5, 1), 3, 1)), testing::ElementsAre(0, 2, 4));
  const auto views = viewsOnGrid(manifestOf(4, 1), 3, 1);
  EXPECT_EQ(views[0].stored, 0);
  EXPECT_FALSE(views[1].stored);
  EXPECT_EQ(views[2].stored, 3);
}

TEST(ViewPlan, ASinglePlaceStandsInTheMiddle) {
  EXPECT_THAT(storedOf(viewsOnGrid(manifestOf(3, 3), 1, 1)), testing::ElementsAre(4));
  EXPECT_FALSE(viewsOnGrid(manifestOf(2, 2), 1, 1)[0].stored);
  const auto views = viewsOnGrid(manifestOf(1, 1), 3, 1);
  EXPECT_FALSE(views[0].stored);
  EXPECT_EQ(views[1].stored, 0);
}

TEST(ViewPlan, OtherViewsHaveNoGrid) {
  Manifest manifest = manifestOf(2, 2);
  manifest.groups[3].view.geometry = PinholeCamera();
  EXPECT_THROW(viewsOnGrid(manifest, 3, 3), Error);
  EXPECT_EQ(viewsAsTheyAre(manifest).size(), 4U);
}

}  // namespace
}  // namespace illum
