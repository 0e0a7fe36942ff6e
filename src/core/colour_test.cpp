#include "illum/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace illum {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The slow and obviously right version.
int slowDisplayByte(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const double x = linear;
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * encoded));
}

TEST(Colour, KnownValuesOfTheSrgbCurve) {
  EXPECT_EQ(displayFromLinear(0), 0);
  EXPECT_FLOAT_EQ(displayFromLinear(1), 1);
  EXPECT_FLOAT_EQ(displayFromLinear(0.001F), 0.01292F);
  EXPECT_NEAR(displayFromLinear(0.18F), 0.46135613, 1e-7);
  EXPECT_NEAR(linearFromDisplay(0.5F), 0.21404114, 1e-7);
  EXPECT_NEAR(linearFromDisplay(0.04045F), 0.04045 / 12.92, 1e-8);
}

TEST(Colour, CurveAndInverseCancel) {
  // Just around the joint of the standard's two pieces they cancel to 1e-7 only; 2^-20 covers it.
  for (int i = -4000; i <= 4000; ++i) {
    const float value = static_cast<float>(i) / 1000;
    const float tolerance = 0x1p-20F * std::max(0.1F, std::abs(value));
    EXPECT_NEAR(linearFromDisplay(displayFromLinear(value)), value, tolerance);
    EXPECT_NEAR(displayFromLinear(linearFromDisplay(value)), value, tolerance);
  }
}

TEST(Colour, CurveIsOddAndRises) {
  float before = -kInfinity;
  for (int i = -2000; i <= 2000; ++i) {
    const float value = static_cast<float>(i) / 500;
    EXPECT_EQ(displayFromLinear(-value), -displayFromLinear(value)) << value;
    EXPECT_EQ(linearFromDisplay(-value), -linearFromDisplay(value)) << value;
    EXPECT_GT(displayFromLinear(value), before) << value;
    before = displayFromLinear(value);
  }
}

TEST(Colour, BytesSurviveTheWayThroughLinearLight) {
  for (int byte = 0; byte < 256; ++byte)
    EXPECT_EQ(displayByteFromLinear(linearFromDisplay(static_cast<float>(byte) / 255)), byte);
}

TEST(Colour, FastBytesEqualSlowBytes) {
  const auto last = std::bit_cast<std::uint32_t>(2.0F);
  for (std::uint32_t bits = 0; bits < last; bits += 977) {
    const auto value = std::bit_cast<float>(bits);
    ASSERT_EQ(displayByteFromLinear(value), slowDisplayByte(value)) << value;
  }
}

TEST(Colour, FastBytesEqualSlowBytesAroundEveryStep) {
  for (int byte = 1; byte < 256; ++byte) {
    const float step = linearFromDisplay((static_cast<float>(byte) - 0.5F) / 255);
    float value = step;
    for (int i = 0; i < 64; ++i) value = std::nextafter(value, 0.0F);
    for (int i = 0; i < 128; ++i, value = std::nextafter(value, 2.0F))
      ASSERT_EQ(displayByteFromLinear(value), slowDisplayByte(value)) << value << " near " << byte;
  }
}

TEST(Colour, BytesClampAndTakeNanAsBlack) {
  for (const auto byteOf : {displayByteFromLinear, byteFromUnit}) {
    EXPECT_EQ(byteOf(-kInfinity), 0);
    EXPECT_EQ(byteOf(-1), 0);
    EXPECT_EQ(byteOf(-0.0F), 0);
    EXPECT_EQ(byteOf(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(byteOf(kNan), 0);
    EXPECT_EQ(byteOf(-kNan), 0);
    EXPECT_EQ(byteOf(1), 255);
    EXPECT_EQ(byteOf(1e30F), 255);
    EXPECT_EQ(byteOf(kInfinity), 255);
  }
}

TEST(Colour, UnitBytesRoundToNearest) {
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(byteFromUnit(static_cast<float>(byte) / 255), byte);
    EXPECT_EQ(byteFromUnit((static_cast<float>(byte) + 0.499F) / 255), byte);
    EXPECT_EQ(byteFromUnit((static_cast<float>(byte) + 0.501F) / 255), std::min(byte + 1, 255));
  }
}

TEST(Colour, SumsAndMultiplesAreLinear) {
  const LinearRgb a{1, 2, 3}, b{0.5F, -1, 4};
  EXPECT_EQ(a + b, (LinearRgb{1.5F, 1, 7}));
  EXPECT_EQ(2 * (a + b), 2 * a + 2 * b);
}

}  // namespace
}  // namespace illum
