#include "study/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <vector>

#include "illum/colour.h"
#include "illum/error.h"
#include "study/fake_capture_for_test.h"
#include "study/object_for_test.h"

namespace illum {
namespace {

constexpr Size kSize{150, 70};

int pattern(int x, int y, int c) {
  return (3 * x + 5 * y + 50 * c) % 256;
}

/// Across several tiles, with a mask.
FlatObject maskedObject() {
  FlatObject object{kSize, pattern, ringOfLights(2), {}};
  object.coverageAt = [](int x, int y) { return (7 * x + y) % 256; };
  return object;
}

FakeCapture photographs() {
  return {kSize, Transfer::Display, ringOfLights(3),
          [](int, int x, int y, int c) { return static_cast<float>(pattern(x, y, c)) / 255; }};
}

TEST(Comparison, ARelitRegionIsACutOfTheWhole) {
  const TemporaryFolder folder("region");
  const Relighter relighter(makeObject(folder.path() / "a.illum", maskedObject()));
  const DirectionalLight light{Direction(), {0.5f, 1, 2}};
  const Picture whole = relighter.relight({&light, 1});
  ASSERT_EQ(whole.channels(), 4);
  for (const Rectangle& region :
       {Rectangle{0, 0, 150, 70}, Rectangle{0, 30, 150, 1}, Rectangle{63, 63, 2, 2},
        Rectangle{64, 64, 1, 1}, Rectangle{149, 69, 1, 1}, Rectangle{10, 5, 100, 64}}) {
    const Picture part = relighter.relightRegion({&light, 1}, region);
    ASSERT_EQ(part.size(), region.size());
    for (int y = 0; y < region.height; ++y)
      for (int x = 0; x < region.width; ++x)
        for (int c = 0; c < 4; ++c)
          ASSERT_EQ(part.at(x, y, c), whole.at(region.x + x, region.y + y, c))
              << region.x << "," << region.y << ": " << x << "," << y;
  }
}

TEST(Comparison, ARegionBeyondThePictureIsRefused) {
  const TemporaryFolder folder("beyond");
  const Relighter relighter(makeObject(folder.path() / "a.illum", maskedObject()));
  for (const Rectangle& region :
       {Rectangle{0, 0, 151, 70}, Rectangle{0, 1, 150, 70}, Rectangle{-1, 0, 2, 2},
        Rectangle{0, 0, 0, 5}, Rectangle{150, 0, 1, 1}, Rectangle{2147483647, 0, 1, 1}})
    EXPECT_THROW(relighter.relightRegion({}, region), Error) << region.x << "," << region.width;
}

TEST(Comparison, BandsOfALightComeInOrderFromTheTop) {
  const TemporaryFolder folder("order");
  const Object object = makeObject(folder.path() / "a.illum", maskedObject());
  FakeCapture capture = photographs();
  capture.withBandRows(8);
  const Comparison comparison(object, capture, {}, 0);
  const std::vector<int> lights{2, 0};
  std::vector<int> next(2, 0);
  std::mutex mutex;
  int calls = 0;
  Progress progress;
  comparison.forEachBand(lights, 0, progress, [&](std::size_t i, const ComparedBand& band) {
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(band.photograph.rows.y, next[i]) << i;
    EXPECT_EQ(band.relit.size(), band.photograph.rows.size());
    EXPECT_EQ(band.relit.channels(), 3);
    next[i] = band.photograph.rows.bottom();
    ++calls;
  });
  EXPECT_THAT(next, testing::ElementsAre(70, 70));
  EXPECT_EQ(static_cast<std::uint64_t>(calls), 2 * comparison.stepCount());
}

TEST(Comparison, BothSidesAreOverBlack) {
  const TemporaryFolder folder("black");
  const Object object = makeObject(folder.path() / "a.illum", maskedObject());
  const FakeCapture capture = photographs();
  const Comparison comparison(object, capture, {}, 0);
  const std::vector<int> lights{0};
  Progress progress;
  comparison.forEachBand(lights, 0, progress, [&](std::size_t, const ComparedBand& band) {
    if (band.photograph.rows.y > 0) return;  // the second row of tiles
    for (const int x : {0, 9, 77, 149}) {
      const float covered = static_cast<float>((7 * x + 33) % 256) / 255;
      const float linear = linearFromDisplay(static_cast<float>(pattern(x, 33, 1)) / 255);
      EXPECT_NEAR(band.relit.at(x, 33, 1), covered * linear, 1e-6) << x;
      EXPECT_NEAR(band.photograph.linear.at(x, 33, 1), covered * linear, 1e-6) << x;
    }
  });
}

/// What forEachBand() hands out of each light, one row after the other.
std::vector<std::vector<float>> photographedUnder(const Comparison& comparison,
                                                  const std::vector<int>& lights) {
  std::vector<std::vector<float>> rows(lights.size());
  Progress progress;
  comparison.forEachBand(lights, 0, progress, [&](std::size_t i, const ComparedBand& band) {
    const auto linear = band.photograph.linear.samples();
    rows[i].insert(rows[i].end(), linear.begin(), linear.end());
  });
  return rows;
}

TEST(Comparison, RenderedLightsAreReadTogetherAndComeOutTheSame) {
  const TemporaryFolder folder("rendered");
  const Object object = makeObject(folder.path() / "a.illum", maskedObject());
  const auto capture = [] {
    return FakeCapture(kSize, Transfer::Linear, ringOfLights(9, {1, 0.5F, 2}),
                       [](int light, int x, int y, int c) {
                         return static_cast<float>(1000 * light + pattern(x, y, c)) / 9000;
                       });
  };
  const std::vector<int> lights{2, 0, 3, 5, 4, 8, 1};
  const FakeCapture photographed = capture();
  const auto expected = photographedUnder({object, photographed, {}, 0}, lights);
  EXPECT_EQ(photographed.lightsOfReads(), std::pair(1, 1));

  FakeCapture rendered = capture();
  rendered.asRendered();
  EXPECT_EQ(photographedUnder({object, rendered, {}, 0}, lights), expected);
  EXPECT_EQ(rendered.lightsOfReads(), std::pair(7, 7));
  EXPECT_EQ(rendered.reads(), 7 * kSize.height) << "each row once";

  // A step is a row of tiles at most, 24 bytes a pixel and light.
  const std::uint64_t threeLights = 2 * 3 * 24 * Size{kSize.width, 64}.pixels();
  const std::uint64_t tiles = 2 * sizeof(std::uint16_t) * kSize.pixels();
  FakeCapture scarce = capture();
  scarce.asRendered();
  const Comparison bounded(object, scarce, {}, threeLights + 4 * tiles);
  EXPECT_EQ(photographedUnder(bounded, lights), expected);
  EXPECT_LT(scarce.lightsOfReads().second, 5);
  EXPECT_GT(scarce.lightsOfReads().second, 1);

  FakeCapture without = capture();
  without.asRendered();
  EXPECT_EQ(photographedUnder({object, without, {}, 1}, lights), expected);
  EXPECT_EQ(without.lightsOfReads(), std::pair(1, 1)) << "no memory for more";
}

}  // namespace
}  // namespace illum
