#include "illum/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "illum/colour.h"

namespace illum {
namespace {

TEST(Rectangle, IsHalfOpen) {
  const Rectangle rectangle{3, 4, 5, 6};
  EXPECT_EQ(rectangle.right(), 8);
  EXPECT_EQ(rectangle.bottom(), 10);
  EXPECT_EQ(rectangle.size(), (Size{5, 6}));
  EXPECT_EQ(rectangle.pixels(), 30U);
}

TEST(Size, CountsPixelsBeyond32Bits) {
  EXPECT_EQ((Size{65535, 65535}).pixels(), 4294836225U);
}

TEST(Picture, KeepsChannelsFastestAndRowsFromTheTop) {
  Picture picture({3, 2}, 4);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      for (int c = 0; c < 4; ++c) picture.at(x, y, c) = static_cast<float>(100 * y + 10 * x + c);
  ASSERT_EQ(picture.samples().size(), 24U);
  EXPECT_EQ(picture.samples()[4], 10);
  EXPECT_EQ(picture.samples()[12], 100);
  EXPECT_EQ(picture.row(1)[5], 111);
  EXPECT_EQ(picture.row(1).size(), 12U);
}

TEST(Picture, StartsBlackAndComparesByContents) {
  Picture a({2, 2}, 3), b({2, 2}, 3);
  EXPECT_EQ(a, b);
  for (const float sample : a.samples()) EXPECT_EQ(sample, 0);
  b.at(1, 1, 2) = 1;
  EXPECT_FALSE(a == b);
  EXPECT_FALSE(a == Picture({4, 1}, 3));
  EXPECT_TRUE(Picture().empty());
}

TEST(DisplayBytes, EncodesEveryChannelOfOpaquePictures) {
  for (const int channels : {1, 3}) {
    Picture linear({2, 1}, channels);
    linear.at(0, 0, channels - 1) = 0.18F;
    linear.at(1, 0, 0) = 7;
    const BytePicture bytes = displayBytes(linear);
    EXPECT_EQ(bytes.size(), linear.size());
    EXPECT_EQ(bytes.channels(), channels);
    EXPECT_EQ(bytes.at(0, 0, channels - 1), 118);
    EXPECT_EQ(bytes.at(1, 0, 0), 255);
  }
}

TEST(DisplayBytes, ExposureDoublesLinearLightPerStop) {
  Picture linear({1, 1}, 1);
  linear.at(0, 0, 0) = 0.05F;
  EXPECT_EQ(displayBytes(linear, 2).at(0, 0, 0), displayByteFromLinear(0.2F));
  EXPECT_EQ(displayBytes(linear, -1).at(0, 0, 0), displayByteFromLinear(0.025F));
}

TEST(DisplayBytes, AlphaBecomesStraightAndIsNotExposed) {
  Picture linear({3, 1}, 4);
  const float premultiplied[3][4] = {
      {0.1F, 0.05F, 0, 0.5F}, {0.3F, 0.3F, 0.3F, 0}, {1, 0.5F, 2, 1}};
  for (int x = 0; x < 3; ++x)
    for (int c = 0; c < 4; ++c) linear.at(x, 0, c) = premultiplied[x][c];
  const BytePicture bytes = displayBytes(linear, 1);
  EXPECT_EQ(bytes.at(0, 0, 0), displayByteFromLinear(0.4F));
  EXPECT_EQ(bytes.at(0, 0, 1), displayByteFromLinear(0.2F));
  EXPECT_EQ(bytes.at(0, 0, 3), 128);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(bytes.at(1, 0, c), 0) << "where nothing covers, nothing is";
  EXPECT_EQ(bytes.at(2, 0, 1), 255);
  EXPECT_EQ(bytes.at(2, 0, 3), 255);
}

TEST(DisplayBytes, NanIsBlackNotUndefined) {
  Picture linear({1, 1}, 4);
  for (float& sample : linear.samples()) sample = std::numeric_limits<float>::quiet_NaN();
  const BytePicture bytes = displayBytes(linear);
  for (const auto byte : bytes.samples()) EXPECT_EQ(byte, 0);
}

}  // namespace
}  // namespace illum
