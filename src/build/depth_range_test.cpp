#include "build/depth_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "codec/depth_tile.h"

namespace illum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How far points of view 0 move in view 1 at most, in pixels, when their depth is rounded.
double farthestMove(const std::vector<View>& views, const DepthRange& range) {
  const ViewGeometry &from = views[0].geometry, &to = views[1].geometry;
  const Size size = sizeOf(from);
  double farthest = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double depth = range.from + (range.to - range.from) * (i + 0.37) / 1001;
    const double step = (range.to - range.from) / range.steps;
    // The worst that rounding to the nearest step can do.
    for (const double rounded : {depth - step / 2, depth + step / 2}) {
      for (const double x : {0.0, 0.5, 1.0}) {
        const PixelPosition at{x * size.width, 0.3 * size.height};
        const auto truth = pixelOf(to, pointAt(from, at, depth));
        const auto moved = pixelOf(to, pointAt(from, at, rounded));
        if (!truth || !moved) continue;
        farthest = std::max(farthest, std::hypot(moved->x - truth->x, moved->y - truth->y));
      }
    }
  }
  return farthest;
}

void expectJustFineEnough(const std::vector<View>& views, double from, double to) {
  const DepthRange range = depthRangeFor(views, 0, from, to);
  EXPECT_EQ(range.from, from);
  EXPECT_EQ(range.to, to);
  const double moved = farthestMove(views, range);
  EXPECT_LE(moved, 1.03 * kDepthErrorPixels) << range.steps << " steps";
  EXPECT_GE(moved, 0.5 * kDepthErrorPixels) << range.steps << " steps are finer than needed";
}

std::vector<View> slabViews(int uCount, int vCount) {
  LightSlab slab;
  slab.name = "slab";
  slab.objectFromSlab = rotationAbout(Direction::fromVector({1, 2, 0}), 0.7);
  slab.distance = 4;
  slab.uv = {-1, -0.5, 1, 0.5};
  slab.uCount = uCount;
  slab.vCount = vCount;
  slab.st = {-1.2, -1, 1.2, 1};
  slab.size = {240, 200};
  // The neighbour that is farther away.
  const bool across = uCount > 1 && (vCount == 1 || 2.0 / (uCount - 1) >= 1.0 / (vCount - 1));
  return {{"a", SlabView{slab, 0, 0}}, {"b", SlabView{slab, across ? 1 : 0, across ? 0 : 1}}};
}

TEST(DepthRange, OfASlabCarriesPointsIntoItsNeighbour) {
  expectJustFineEnough(slabViews(5, 3), -1.5, 1);
  expectJustFineEnough(slabViews(17, 3), -3, 2);
  expectJustFineEnough(slabViews(1, 9), -1, 0.5);
}

TEST(DepthRange, OfACameraCarriesPointsIntoTheNearestOther) {
  PinholeCamera near, next, far;
  near.size = next.size = far.size = {320, 240};
  near.focalX = near.focalY = next.focalX = next.focalY = 300;
  near.centre = next.centre = far.centre = {160, 120};
  next.objectFromCamera.translation = {0.2, 0.1, 0};
  far.objectFromCamera.translation = {5, 0, 0};
  expectJustFineEnough({{"a", near}, {"b", next}, {"c", far}}, 2, 6);
}

TEST(DepthRange, OfAPanorama) {
  Panorama here, there;
  here.size = there.size = {1024, 512};
  there.objectFromCamera.translation = {0, 0, -0.3};
  const std::vector<View> views{{"a", here}, {"b", there}};
  const DepthRange range = depthRangeFor(views, 0, 1, 9);
  EXPECT_LE(farthestMove(views, range), 1.7 * kDepthErrorPixels) << "near the other eye it is more";
}

TEST(DepthRange, OfASingleViewIsOfItsPixelsSize) {
  const DepthRange photograph = depthRangeFor({{"p", OrthographicView{{512, 300}}}}, 0, -0.5, 0.5);
  const double pixel = 2.0 / 512;
  EXPECT_NEAR(1.0 / photograph.steps, 2 * kDepthErrorPixels * pixel, 0.01 * pixel);
  const auto alone = slabViews(1, 1);
  const DepthRange slab = depthRangeFor({alone[0]}, 0, -1, 1);
  EXPECT_GT(slab.steps, 10);
  EXPECT_LT(slab.steps, 10000);
}

TEST(DepthRange, HasAtLeastOneStepAndAtMostAllThatFit) {
  EXPECT_EQ(depthRangeFor(slabViews(5, 5), 0, 0.25, 0.25).steps, 1) << "a plane";
  EXPECT_EQ(depthRangeFor(slabViews(5, 5), 0, -1e9, 1).steps, kMaxDepthSteps);
}

/// Depths of a ramp with a hole.
class RampOfDepths final : public Capture {
 public:
  explicit RampOfDepths(float hole) : hole_(hole) { views_ = slabViews(5, 5); }
  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return Transfer::Linear; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return true; }
  bool hasDepth() const override { return true; }
  void read(int, const Rectangle&, std::span<const int>, std::span<float>) const override {}
  void readMask(int, const Rectangle&, std::span<float>) const override {}
  void readDepth(int, const Rectangle& r, std::span<float> depth) const override {
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const int row = r.y + static_cast<int>(i) / r.width;
      depth[i] = row < 100 ? hole_ : -0.01f * static_cast<float>(row);
    }
  }
  int bandRows() const override { return 1000; }
  std::uint64_t residentBytes() const override { return 0; }
  std::string fingerprint() const override { return {}; }

 private:
  std::vector<View> views_;
  std::vector<LightFileEntry> lights_;
  float hole_;
};

TEST(DepthRange, IsThatOfAllDepthsThatThereAre) {
  const DepthRange range = depthRangeOf(RampOfDepths(static_cast<float>(kInfinity)), 1);
  EXPECT_FLOAT_EQ(static_cast<float>(range.from), -0.01f * 199);
  EXPECT_FLOAT_EQ(static_cast<float>(range.to), -0.01f * 100);
  const DepthRange whole = depthRangeOf(RampOfDepths(0.5f), 1);
  EXPECT_EQ(whole.to, 0.5);
}

}  // namespace
}  // namespace illum
