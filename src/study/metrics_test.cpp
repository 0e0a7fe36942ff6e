#include "study/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "illum/error.h"

namespace illum {
namespace {

BytePicture filled(Size size, int channels, int value) {
  BytePicture picture(size, channels);
  for (auto& sample : picture.samples()) sample = static_cast<std::uint8_t>(value);
  return picture;
}

TEST(Metrics, IdenticalPicturesHave99Decibels) {
  const BytePicture a = filled({16, 16}, 3, 77);
  const PictureError error = comparePictures(a, a);
  EXPECT_EQ(error.psnrDecibels, 99);
  EXPECT_EQ(error.rms, 0);
  EXPECT_NEAR(error.ssim, 1, 1e-6);
}

TEST(Metrics, AConstantOffsetHasAClosedForm) {
  for (const int offset : {1, 2, 10, 155}) {
    const PictureError error =
        comparePictures(filled({13, 17}, 3, 100 + offset), filled({13, 17}, 3, 100));
    EXPECT_NEAR(error.psnrDecibels, 20 * std::log10(255.0 / offset), 1e-12) << offset;
    EXPECT_NEAR(error.rms, offset / 255.0, 1e-15) << offset;
  }
}

TEST(Metrics, BlackAgainstWhiteIsZeroDecibels) {
  const PictureError error = comparePictures(filled({8, 8}, 1, 0), filled({8, 8}, 1, 255));
  EXPECT_EQ(error.psnrDecibels, 0);
  EXPECT_EQ(error.rms, 1);
}

TEST(Metrics, OneChannelOfOnePixelCounts) {
  const BytePicture a = filled({10, 10}, 3, 50);
  BytePicture b = a;
  b.at(3, 4, 2) = 60;
  EXPECT_NEAR(comparePictures(a, b).psnrDecibels, 10 * std::log10(255.0 * 255 / (100.0 / 300)),
              1e-12);
}

TEST(Metrics, NoiseOfKnownVarianceGivesItsPsnr) {
  constexpr double kSigma = 5;
  const BytePicture a = filled({200, 200}, 3, 128);
  BytePicture b = a;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(128, kSigma);
  for (auto& sample : b.samples()) sample = static_cast<std::uint8_t>(std::lround(normal(random)));
  // Rounding adds the variance of a uniform unit interval.
  const double expected = 10 * std::log10(255 * 255 / (kSigma * kSigma + 1.0 / 12));
  EXPECT_NEAR(comparePictures(a, b).psnrDecibels, expected, 0.05);
}

TEST(Metrics, PsnrNeverExceedsThatOfIdenticalPictures) {
  EXPECT_EQ(psnrDecibels(1e-12, 255), 99);
  EXPECT_EQ(psnrDecibels(0, 1), 99);
  EXPECT_NEAR(psnrDecibels(0.01, 1), 20, 1e-12);
  EXPECT_TRUE(std::isnan(psnrDecibels(std::nan(""), 1)));
}

TEST(Metrics, AMaskSeparatesGoodFromBad) {
  const BytePicture a = filled({20, 10}, 3, 100);
  BytePicture b = a;
  std::vector<std::uint8_t> left(200), right(200), nowhere(200, 0);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      (x < 10 ? left : right)[static_cast<std::size_t>(y * 20 + x)] = 1;
      if (x < 10)
        for (int c = 0; c < 3; ++c) b.at(x, y, c) = 110;
    }
  }
  EXPECT_NEAR(comparePictures(a, b, left).inside.psnrDecibels, 20 * std::log10(25.5), 1e-12);
  EXPECT_EQ(comparePictures(a, b, right).inside.psnrDecibels, 99);
  EXPECT_NEAR(comparePictures(a, b, left).all.psnrDecibels, 10 * std::log10(255 * 255 / 50.0),
              1e-12);
  EXPECT_TRUE(std::isnan(comparePictures(a, b, nowhere).inside.psnrDecibels));
  EXPECT_TRUE(std::isnan(comparePictures(a, b, nowhere).inside.rms));
}

TEST(Metrics, WithoutAMaskBothFiguresAreOne) {
  const MaskedErrors errors = comparePictures(filled({9, 9}, 1, 1), filled({9, 9}, 1, 9), {});
  EXPECT_EQ(errors.all.psnrDecibels, errors.inside.psnrDecibels);
  EXPECT_EQ(errors.all.ssim, errors.inside.ssim);
}

TEST(Metrics, DifferentPicturesAreRefused) {
  EXPECT_THROW(comparePictures(filled({4, 4}, 3, 0), filled({4, 5}, 3, 0)), Error);
  EXPECT_THROW(comparePictures(filled({4, 4}, 3, 0), filled({4, 4}, 1, 0)), Error);
  EXPECT_THROW(comparePictures(filled({4, 4}, 4, 0), filled({4, 4}, 4, 0)), Error);
  EXPECT_THROW(comparePictures(BytePicture(), BytePicture()), Error);
}

TEST(Metrics, SquaredErrorOfNothingDoesNotExist) {
  SquaredError error;
  EXPECT_TRUE(std::isnan(error.mean()));
  error.add(3);
  error.add(-4);
  EXPECT_DOUBLE_EQ(error.mean(), 12.5);
  EXPECT_DOUBLE_EQ(error.rms(), std::sqrt(12.5));
}

}  // namespace
}  // namespace illum
