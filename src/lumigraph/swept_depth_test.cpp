#include "lumigraph/swept_depth.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <vector>

#include "lumigraph/analytic_scene_for_test.h"

namespace illum {
namespace {

constexpr int kPixels = 96;

// A camera and four about it, all looking the same way: a textured ball before a textured wall.
class SweptDepth : public ::testing::Test {
 protected:
  SweptDepth() {
    AnalyticScene scene;
    scene.wallHalf = 9;
    for (const auto& [x, y] :
         {std::pair(0.0, 0.0), {0.12, 0.0}, {-0.12, 0.0}, {0.0, 0.12}, {0.0, -0.12}}) {
      PinholeCamera camera = cameraAt({x, y, 2}, {x, y, 0}, kPixels);
      views_.push_back(seen(scene, {"", camera}));
      small_.push_back({ViewProjector(views_.back().view.geometry),
                        SmallPicture(views_.back().picture, kSweptSide)});
    }
  }
  Picture swept(std::size_t neighbours = kSweptNeighbours) const {
    std::vector<const SmallView*> others;
    for (std::size_t i = 1; i <= neighbours; ++i) others.push_back(&small_[i]);
    return sweptDepth(views_[0].picture, small_[0], others);
  }
  // The share of pixels whose error moves them by less than a pixel in the neighbours' pictures.
  double shareRight(const Picture& found) const {
    const double shiftTimesDepth = 0.12 * 1.3 * kPixels;
    int right = 0;
    for (std::size_t i = 0; i < found.size().pixels(); ++i) {
      const double shift = shiftTimesDepth / found.samples()[i];
      if (std::abs(shift - shiftTimesDepth / views_[0].depth.samples()[i]) < 1) ++right;
    }
    return right / static_cast<double>(found.size().pixels());
  }

  std::vector<SourceView> views_;
  std::vector<SmallView> small_;
};

TEST_F(SweptDepth, IsThatOfTheThings) {
  EXPECT_GT(shareRight(swept()), 0.95);
}

TEST_F(SweptDepth, OneNeighbourTellsMostOfIt) {
  EXPECT_GT(shareRight(swept(1)), 0.85);
}

TEST_F(SweptDepth, IsTheSameOnAnyNumberOfThreads) {
  const Picture many = swept();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, swept());
}

TEST_F(SweptDepth, OfLargePicturesIsFoundInSmallOnes) {
  AnalyticScene scene;
  scene.wallHalf = 9;
  std::vector<SmallView> small;
  std::vector<SourceView> views;
  for (const double x : {0.0, 0.12, -0.12}) {
    PinholeCamera camera = cameraAt({x, 0, 2}, {x, 0, 0}, 2 * kSweptSide);
    camera.size.height = 64;
    camera.centre.y = 32;
    views.push_back(seen(scene, {"", camera}, 1));
    small.push_back({ViewProjector(views.back().view.geometry),
                     SmallPicture(views.back().picture, kSweptSide)});
    EXPECT_EQ(small.back().picture.shrink(), 2);
  }
  const std::vector<const SmallView*> others{&small[1], &small[2]};
  const Picture found = sweptDepth(views[0].picture, small[0], others);
  ASSERT_EQ(found.size(), views[0].picture.size());
  int right = 0;
  for (std::size_t i = 0; i < found.size().pixels(); ++i)
    right += std::abs(found.samples()[i] / views[0].depth.samples()[i] - 1) < 0.05 ? 1 : 0;
  EXPECT_GT(right, 0.9 * static_cast<double>(found.size().pixels()));
}

}  // namespace
}  // namespace illum
