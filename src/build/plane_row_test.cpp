#include "build/plane_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace illum {
namespace {

// One light; every channel of a pixel is its column plus a hundredth of its row.
class RampCapture final : public Capture {
 public:
  RampCapture(Size size, int band, bool mask)
      : views_{{"ramp", OrthographicView{size}}}, band_(band), mask_(mask) {
    lights_.push_back({"a", {}, 1});
  }
  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return Transfer::Linear; }
  const std::vector<LightFileEntry>& lights() const override { return lights_; }
  bool hasMask() const override { return mask_; }
  static float value(int x, int y) { return static_cast<float>(x) + 0.01f * static_cast<float>(y); }
  void read(int, const Rectangle& r, std::span<const int> lights,
            std::span<float> samples) const override {
    for (std::size_t i = 0; i < 3 * lights.size() * r.pixels(); ++i) {
      const auto p = static_cast<int>(i % r.pixels());
      samples[i] = value(r.x + p % r.width, r.y + p / r.width);
    }
  }
  void readMask(int, const Rectangle& r, std::span<float> coverage) const override {
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      coverage[i] = r.x + static_cast<int>(i) % r.width < size().width / 2 ? 1.0f : 0.0f;
    }
  }
  bool hasDepth() const override { return true; }
  // Falls away to the right, with a hole.
  static float depthAt(int x, int y) {
    const bool hole = x >= 100 && x < 103 && y < 40;
    return hole ? std::numeric_limits<float>::infinity() : -value(x, y);
  }
  void readDepth(int, const Rectangle& r, std::span<float> depth) const override {
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const auto p = static_cast<int>(i);
      depth[i] = depthAt(r.x + p % r.width, r.y + p / r.width);
    }
  }
  int bandRows() const override { return band_; }
  std::uint64_t residentBytes() const override { return 0; }
  std::string fingerprint() const override { return {}; }

 private:
  std::vector<View> views_;
  int band_;
  bool mask_;
  std::vector<LightFileEntry> lights_;
};

Progress silent;

Manifest manifestFor(Size size, int tile, bool mask) {
  Manifest manifest;
  manifest.groups = {{{"ramp", OrthographicView{size}}, 0, {}}};
  manifest.tile = tile;
  manifest.mask = mask;
  return manifest;
}

// Plane 0 is red, plane 1 is twice green plus one.
PlaneOperator twoPlanes() {
  return {.planes = 2, .lights = 1, .matrix = {1, 0, 0, 0, 2, 0}, .offset = {0, 1}, .picks = {}};
}

TEST(RowFitter, EveryTexelOfEveryRowIsFitted) {
  for (const int band : {3, 8, 64, 1000}) {
    const Size size{1101, 150};
    const RampCapture capture(size, band, false);
    const auto manifest = manifestFor(size, 64, false);
    const auto op = twoPlanes();
    const std::vector<int> lights{0};
    RowFitter fitter(capture, lights, {&op}, manifest, silent);
    for (int row = 0; row < 3; ++row) {
      const PlaneRow& out = fitter.fit(0, row);
      ASSERT_EQ(out.size.height, row < 2 ? 64 : 22);
      for (int y = 0; y < out.size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const auto i = static_cast<std::size_t>(y * size.width + x);
          const float v = RampCapture::value(x, 64 * row + y);
          ASSERT_NEAR(out.values[i], v, 1e-3) << band << ' ' << x << ' ' << y;
          ASSERT_NEAR(out.values[out.size.pixels() + i], 2 * v + 1, 1e-3) << x << ' ' << y;
        }
      }
    }
  }
}

struct Seen {
  std::vector<std::pair<int, int>> rows;  // level, row
  std::vector<PlaneRow> last;             // of each level
};

Seen runPyramid(Size size, bool mask, bool depth = false) {
  auto manifest = manifestFor(size, 64, mask);
  if (depth) manifest.groups[0].depth = DepthRange{-300, 0, 1000};
  const RampCapture capture(size, 64, mask);
  const auto op = twoPlanes();
  const std::vector<int> lights{0};
  Seen seen;
  seen.last.resize(3);
  LevelPyramid pyramid(manifest, [&](const PlaneRow& row) {
    seen.rows.emplace_back(row.level, row.row);
    seen.last[static_cast<std::size_t>(row.level)] = row;
  });
  RowFitter fitter(capture, lights, {&op}, manifest, silent);
  for (int row = 0; row < manifest.grid(0).tilesDown(0); ++row) pyramid.add(fitter.fit(0, row));
  return seen;
}

TEST(LevelPyramid, EmitsEveryRowOfEveryLevelOnce) {
  const auto seen = runPyramid({250, 200}, false);
  const std::vector<std::pair<int, int>> expected{{0, 0}, {0, 1}, {1, 0}, {0, 2},
                                                  {0, 3}, {1, 1}, {2, 0}};
  EXPECT_EQ(seen.rows, expected);
}

TEST(LevelPyramid, CoarserTexelsAreMeansOfTheirBlocks) {
  const auto seen = runPyramid({250, 200}, false);
  const PlaneRow& coarse = seen.last[2];
  ASSERT_EQ(coarse.size, (Size{63, 50}));
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 62; ++x) {
      const float mean = RampCapture::value(4 * x, 4 * y) + 1.5f + 0.015f;
      ASSERT_NEAR(coarse.values[static_cast<std::size_t>(63 * y + x)], mean, 1e-3) << x << ' ' << y;
    }
  }
}

TEST(LevelPyramid, HiddenTexelsDoNotBleed) {
  const auto seen = runPyramid({250, 200}, true);
  const PlaneRow& coarse = seen.last[1];
  // Columns 124 and 125 straddle the mask's edge: only 124 counts.
  const float kept = coarse.values[62];
  EXPECT_NEAR(kept, 124 + 0.01 * (128 + 0.5), 0.01);
  EXPECT_NEAR(coarse.coverage[62], 0.5, 1e-6);
  EXPECT_EQ(coarse.coverage[63], 0);
}

TEST(LevelPyramid, DepthsAreMediansNeverMeans) {
  EXPECT_TRUE(runPyramid({250, 200}, false).last[0].depth.empty());
  const auto seen = runPyramid({250, 200}, false, true);
  const PlaneRow& fine = seen.last[0];  // the last row of tiles, which has no hole
  for (int x = 0; x < 250; ++x)
    ASSERT_EQ(fine.depth[static_cast<std::size_t>(x)], RampCapture::depthAt(x, 192));
  // Columns 2 i and 2 i + 1 of rows 128 and 129 below each texel of the second row of level 1: the
  // second least of four.
  const PlaneRow& coarse = seen.last[1];
  for (int i = 0; i < 125; ++i)
    ASSERT_EQ(coarse.depth[static_cast<std::size_t>(i)], RampCapture::depthAt(2 * i + 1, 128)) << i;
}

TEST(LevelPyramid, DepthsBesideAHoleAreThoseThatAreThere) {
  const auto manifest = [] {
    auto m = manifestFor({250, 60}, 64, false);
    m.groups[0].depth = DepthRange{-300, 0, 1000};
    return m;
  }();
  const RampCapture capture({250, 60}, 64, false);
  const auto op = twoPlanes();
  const std::vector<int> lights{0};
  PlaneRow coarse;
  LevelPyramid pyramid(manifest, [&](const PlaneRow& row) {
    if (row.level == 1) coarse = row;
  });
  RowFitter fitter(capture, lights, {&op}, manifest, silent);
  pyramid.add(fitter.fit(0, 0));
  EXPECT_TRUE(std::isinf(coarse.depth[50])) << "columns 100 and 101 are a hole";
  EXPECT_EQ(coarse.depth[51], RampCapture::depthAt(103, 1)) << "the lower of two: the farther";
}

}  // namespace
}  // namespace illum
