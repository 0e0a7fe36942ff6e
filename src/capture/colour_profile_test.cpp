#include "capture/colour_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "capture/test_photographs.h"
#include "illum/colour.h"
#include "illum/error.h"

namespace illum {
namespace {

PhotographHeader headerOf(std::vector<std::byte> profile, SampleType type, bool alpha = false) {
  PhotographHeader header;
  header.profile = std::move(profile);
  header.type = type;
  header.alpha = alpha;
  return header;
}

TEST(ColourProfiles, WithoutAProfileSamplesStayAsTheyAre) {
  ColourProfiles profiles;
  PhotographHeader header = headerOf({}, SampleType::Float);
  header.transfer = Transfer::Linear;
  const ProfiledColour& colour = profiles.colourOf("a", header);
  EXPECT_EQ(colour.conversion, nullptr);
  EXPECT_EQ(colour.type, SampleType::Float);
  EXPECT_EQ(colour.transfer, Transfer::Linear);
}

TEST(ColourProfiles, SrgbAndLinearRec709NeedNoConversion) {
  ColourProfiles profiles;
  for (const SampleType type : {SampleType::Byte, SampleType::Word}) {
    const auto& display = profiles.colourOf("a", headerOf(test::displayProfile(), type));
    EXPECT_EQ(display.conversion, nullptr);
    EXPECT_EQ(display.transfer, Transfer::Display);
    EXPECT_EQ(display.type, type);
    const auto& linear = profiles.colourOf("a", headerOf(test::powerProfile(1, false), type));
    EXPECT_EQ(linear.conversion, nullptr);
    EXPECT_EQ(linear.transfer, Transfer::Linear);
  }
}

TEST(ColourProfiles, EqualProfilesShareAConversion) {
  ColourProfiles profiles;
  const auto first =
      profiles.colourOf("a", headerOf(test::powerProfile(1.8, true), SampleType::Byte));
  const auto second =
      profiles.colourOf("b", headerOf(test::powerProfile(1.8, true), SampleType::Byte));
  EXPECT_NE(first.conversion, nullptr);
  EXPECT_EQ(first.conversion, second.conversion);
  EXPECT_NE(
      profiles.colourOf("c", headerOf(test::powerProfile(2.0, true), SampleType::Byte)).conversion,
      first.conversion);
}

// Words and floats against the formula: power, Adobe RGB (1998) to Rec.709 (both D65), sRGB's
// function.
TEST(ColourProfiles, ConversionsFollowTheFormula) {
  constexpr double kGamma = 563 / 256.0;
  const double matrix[3][3] = {{1.39836, -0.39836, 0}, {0, 1, 0}, {0, -0.04293, 1.04293}};
  ColourProfiles profiles;
  const auto word =
      profiles.colourOf("a", headerOf(test::powerProfile(kGamma, true), SampleType::Word, true));
  const auto real =
      profiles.colourOf("a", headerOf(test::powerProfile(kGamma, true), SampleType::Float, true));
  ASSERT_NE(word.conversion, nullptr);
  ASSERT_NE(real.conversion, nullptr);
  EXPECT_EQ(word.transfer, Transfer::Display);
  EXPECT_EQ(real.transfer, Transfer::Linear);
  for (const std::array<double, 3> colour :
       {std::array{0.5, 0.5, 0.5}, std::array{0.6, 0.55, 0.4}, std::array{0.1, 0.1, 0.12}}) {
    std::array<std::uint16_t, 4> words{}, wordsOut{};
    std::array<float, 4> floats{}, floatsOut{};
    for (std::size_t c = 0; c < 3; ++c) {
      words[c] = static_cast<std::uint16_t>(std::lround(65535 * colour[c]));
      floats[c] = static_cast<float>(colour[c]);
    }
    words[3] = 12345;
    floats[3] = 0.25f;
    word.conversion->apply(reinterpret_cast<const std::byte*>(words.data()),
                           reinterpret_cast<std::byte*>(wordsOut.data()), 1);
    real.conversion->apply(reinterpret_cast<const std::byte*>(floats.data()),
                           reinterpret_cast<std::byte*>(floatsOut.data()), 1);
    EXPECT_EQ(wordsOut[3], 12345);
    EXPECT_FLOAT_EQ(floatsOut[3], 0.25f);
    for (std::size_t c = 0; c < 3; ++c) {
      double linear = 0;
      for (std::size_t k = 0; k < 3; ++k) linear += matrix[c][k] * std::pow(colour[k], kGamma);
      EXPECT_NEAR(floatsOut[c], linear, 5e-4);
      EXPECT_NEAR(wordsOut[c] / 65535.0, displayFromLinear(static_cast<float>(linear)), 5e-4);
    }
  }
}

TEST(ColourProfiles, BytesBecomeWordsSoThatNoStepIsLost) {
  ColourProfiles profiles;
  const auto colour =
      profiles.colourOf("a", headerOf(test::powerProfile(1.8, false), SampleType::Byte));
  EXPECT_EQ(colour.type, SampleType::Word);
  std::vector<std::byte> row(3 * 256), out(2 * row.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<std::byte>(i / 3);
  colour.conversion->apply(row.data(), out.data(), 256);
  int previous = -1;
  for (std::size_t i = 0; i < 256; ++i) {
    std::uint16_t word = 0;
    std::memcpy(&word, &out[6 * i], sizeof word);
    EXPECT_GT(word, previous) << i;
    const auto linear = static_cast<float>(std::pow(static_cast<double>(i) / 255, 1.8));
    EXPECT_NEAR(word / 65535.0, displayFromLinear(linear), 1e-3) << i;
    previous = word;
  }
}

TEST(ColourProfiles, AProfileOfAnotherKindOfPictureIsNoUse) {
  ColourProfiles profiles;
  PhotographHeader grey = headerOf(test::powerProfile(1.8, true), SampleType::Byte);
  grey.colours = 1;
  EXPECT_EQ(profiles.colourOf("a", grey).conversion, nullptr);
}

TEST(ColourProfiles, DamageIsAnErrorThatNamesTheFile) {
  ColourProfiles profiles;
  const std::vector<std::byte> whole = test::powerProfile(1.8, true);
  for (std::size_t length = 1; length < whole.size(); length += 5) {
    std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    try {
      profiles.colourOf("photo.jpg", headerOf(cut, SampleType::Byte));
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("photo.jpg: expected "));
      continue;
    }
    // What says how white was adapted comes last, and is not needed.
    EXPECT_GE(length + 44, whole.size()) << length;
  }
}

}  // namespace
}  // namespace illum
