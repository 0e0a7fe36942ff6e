#include "study/photograph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "illum/colour.h"
#include "study/fake_capture_for_test.h"

namespace illum {
namespace {

/// Every byte once, in a 16x16 picture; channels differ.
int byteAt(int light, int x, int y, int channel) {
  return (x + 16 * y + 7 * channel + 3 * light) % 256;
}

BytePicture wholeBytes(const Capture& capture, int light, const BytePicture& coverage = {}) {
  const Size size = capture.size();
  return readPhotograph(capture, 0, light, {0, 0, size.width, size.height}, coverage).bytes;
}

TEST(Photograph, DisplayReferredBytesComeBackExactly) {
  const FakeCapture capture({16, 16}, Transfer::Display, ringOfLights(2),
                            [](int light, int x, int y, int c) {
                              return static_cast<float>(byteAt(light, x, y, c)) / 255;
                            });
  for (const int light : {0, 1}) {
    const BytePicture whole = wholeBytes(capture, light);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(whole.at(x, y, c), byteAt(light, x, y, c)) << light << " " << x << " " << y;
  }
}

TEST(Photograph, DisplayReferredBytesSurviveTheDivisionByIntensity) {
  // What a capture does with an exposure per light: divided in linear light, encoded again.
  const LinearRgb intensity{0.37f, 1.9f, 0.71f};
  const FakeCapture capture(
      {16, 16}, Transfer::Display, ringOfLights(1, intensity), [&](int light, int x, int y, int c) {
        const float factor[] = {intensity.r, intensity.g, intensity.b};
        const float linear = linearFromDisplay(static_cast<float>(byteAt(light, x, y, c)) / 255);
        return displayFromLinear(linear / factor[c]);
      });
  const BytePicture whole = wholeBytes(capture, 0);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) ASSERT_EQ(whole.at(x, y, c), byteAt(0, x, y, c)) << x << " " << y;
}

TEST(Photograph, LinearSamplesAreShownTimesTheirIntensity) {
  const FakeCapture capture({4, 4}, Transfer::Linear, ringOfLights(1, {2, 1, 0.5f}),
                            [](int, int, int, int) { return 0.25f; });
  const PhotographBand band = readPhotograph(capture, 0, 0, {0, 0, 4, 4}, {});
  EXPECT_EQ(band.linear.at(1, 1, 0), 0.5f);
  EXPECT_EQ(band.linear.at(1, 1, 2), 0.125f);
  EXPECT_EQ(band.bytes.at(1, 1, 0), displayByteFromLinear(0.5f));
  EXPECT_EQ(band.bytes.at(1, 1, 1), displayByteFromLinear(0.25f));
}

TEST(Photograph, CoverageMultipliesInLinearLight) {
  const FakeCapture capture({3, 1}, Transfer::Display, ringOfLights(1),
                            [](int, int, int, int) { return 200.0f / 255; });
  BytePicture coverage({3, 1}, 1);
  coverage.at(0, 0, 0) = 255;
  coverage.at(1, 0, 0) = 51;
  const BytePicture whole = wholeBytes(capture, 0, coverage);
  EXPECT_EQ(whole.at(0, 0, 0), 200);
  EXPECT_EQ(whole.at(1, 0, 1), displayByteFromLinear(0.2f * linearFromDisplay(200.0f / 255)));
  EXPECT_EQ(whole.at(2, 0, 2), 0);
}

TEST(Photograph, ABandIsACutOfTheWhole) {
  const FakeCapture capture(
      {5, 13}, Transfer::Display, ringOfLights(1),
      [](int, int x, int y, int) { return static_cast<float>(y * 5 + x) / 255; });
  BytePicture coverage({5, 13}, 1);
  for (std::size_t i = 0; i < 65; ++i) coverage.samples()[i] = i % 2 == 0 ? 255 : 0;
  const PhotographBand band = readPhotograph(capture, 0, 0, {0, 4, 5, 3}, coverage);
  EXPECT_EQ(band.rows, (Rectangle{0, 4, 5, 3}));
  ASSERT_EQ(band.bytes.size(), (Size{5, 3}));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      const int value = 5 * (4 + y) + x;
      EXPECT_EQ(band.bytes.at(x, y, 1), value % 2 == 0 ? value : 0) << x << " " << y;
    }
}

std::vector<int> endsOf(const std::vector<Rectangle>& steps) {
  std::vector<int> ends;
  for (const Rectangle& rows : steps) {
    EXPECT_EQ(rows.y, ends.empty() ? 0 : ends.back());
    ends.push_back(rows.bottom());
  }
  return ends;
}

TEST(Photograph, StepsCrossNeitherBandsNorTiles) {
  using testing::ElementsAre;
  FakeCapture capture({100, 50}, Transfer::Linear, ringOfLights(1),
                      [](int, int, int, int) { return 0.0f; });
  EXPECT_THAT(endsOf(stepsDown(capture, 0, 512)), ElementsAre(50));
  EXPECT_THAT(endsOf(stepsDown(capture, 0, 20)), ElementsAre(20, 40, 50));
  EXPECT_THAT(endsOf(stepsDown(capture.withBandRows(16), 0, 20)),
              ElementsAre(16, 20, 32, 40, 48, 50));
  EXPECT_THAT(endsOf(stepsDown(capture.withBandRows(64), 0, 512)), ElementsAre(50));
}

TEST(Photograph, StepsAreOfBoundedSize) {
  const FakeCapture wide({1 << 18, 5}, Transfer::Linear, ringOfLights(1),
                         [](int, int, int, int) { return 0.0f; });
  EXPECT_THAT(endsOf(stepsDown(wide, 0, 512)), testing::ElementsAre(2, 4, 5));
  const FakeCapture wider({1 << 20, 2}, Transfer::Linear, ringOfLights(1),
                          [](int, int, int, int) { return 0.0f; });
  EXPECT_THAT(endsOf(stepsDown(wider, 0, 512)), testing::ElementsAre(1, 2));
}

TEST(Photograph, TheMaskIsReadAsBytes) {
  FakeCapture capture({300, 40}, Transfer::Linear, ringOfLights(1),
                      [](int, int, int, int) { return 0.0f; });
  EXPECT_TRUE(coverageOf(capture, 0).empty());
  capture.withBandRows(7).withMask(
      [](int x, int y) { return static_cast<float>((x + y) % 256) / 255; });
  const BytePicture coverage = coverageOf(capture, 0);
  ASSERT_EQ(coverage.size(), capture.size());
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 300; ++x) ASSERT_EQ(coverage.at(x, y, 0), (x + y) % 256);
}

}  // namespace
}  // namespace illum
