#include "study/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace illum {
namespace {

BytePicture noise(Size size, int channels, unsigned seed, int low = 0, int high = 255) {
  BytePicture picture(size, channels);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> values(low, high);
  for (auto& sample : picture.samples()) sample = static_cast<std::uint8_t>(values(random));
  return picture;
}

BytePicture constant(Size size, int value) {
  BytePicture picture(size, 1);
  for (auto& sample : picture.samples()) sample = static_cast<std::uint8_t>(value);
  return picture;
}

double lumaAt(const BytePicture& picture, int x, int y) {
  if (picture.channels() == 1) return picture.at(x, y, 0);
  return 0.2126 * picture.at(x, y, 0) + 0.7152 * picture.at(x, y, 1) + 0.0722 * picture.at(x, y, 2);
}

double gauss(int side, int t) {
  double sum = 0;
  for (int i = 0; i < side; ++i) sum += std::exp(-std::pow((i - side / 2) / 1.5, 2) / 2);
  return std::exp(-std::pow((t - side / 2) / 1.5, 2) / 2) / sum;
}

/// Equations 14 to 16 and 13 of the paper, word by word, for the window with this top left corner.
double slowSimilarity(const BytePicture& a, const BytePicture& b, int left, int top, int sideX,
                      int sideY) {
  double meanA = 0, meanB = 0, varianceA = 0, varianceB = 0, covariance = 0;
  const auto forEach = [&](auto&& use) {
    for (int y = 0; y < sideY; ++y)
      for (int x = 0; x < sideX; ++x)
        use(gauss(sideX, x) * gauss(sideY, y), lumaAt(a, left + x, top + y),
            lumaAt(b, left + x, top + y));
  };
  forEach([&](double w, double x, double y) { meanA += w * x, meanB += w * y; });
  forEach([&](double w, double x, double y) {
    varianceA += w * (x - meanA) * (x - meanA);
    varianceB += w * (y - meanB) * (y - meanB);
    covariance += w * (x - meanA) * (y - meanB);
  });
  const double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  return (2 * meanA * meanB + c1) * (2 * covariance + c2) /
         ((meanA * meanA + meanB * meanB + c1) * (varianceA + varianceB + c2));
}

Ssim slowSsim(const BytePicture& a, const BytePicture& b, const std::vector<std::uint8_t>& inside) {
  const auto sideOf = [](int length) { return length >= 11 ? 11 : length - (length % 2 == 0); };
  const int sideX = sideOf(a.width()), sideY = sideOf(a.height());
  double sum = 0, insideSum = 0;
  int count = 0, insideCount = 0;
  for (int top = 0; top + sideY <= a.height(); ++top) {
    for (int left = 0; left + sideX <= a.width(); ++left) {
      const double s = slowSimilarity(a, b, left, top, sideX, sideY);
      const int centre = (top + sideY / 2) * a.width() + left + sideX / 2;
      sum += s;
      ++count;
      if (inside[static_cast<std::size_t>(centre)] == 0) continue;
      insideSum += s;
      ++insideCount;
    }
  }
  return {sum / count, insideSum / insideCount};
}

TEST(Ssim, AgreesWithTheSlowVersion) {
  for (const Size size : {Size{11, 11}, Size{12, 30}, Size{37, 23}, Size{5, 40}, Size{40, 8}}) {
    for (const int channels : {1, 3}) {
      SCOPED_TRACE(testing::Message() << size.width << "x" << size.height << "x" << channels);
      const BytePicture a = noise(size, channels, 1, 40, 200);
      BytePicture b = a;
      const BytePicture disturbance = noise(size, channels, 2, 0, 50);
      for (std::size_t i = 0; i < b.samples().size(); ++i)
        b.samples()[i] = static_cast<std::uint8_t>(b.samples()[i] + disturbance.samples()[i]);
      std::vector<std::uint8_t> inside(size.pixels());
      for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = i % 3 == 0;

      const Ssim slow = slowSsim(a, b, inside), fast = structuralSimilarity(a, b, inside);
      EXPECT_NEAR(fast.all, slow.all, 2e-5);
      EXPECT_NEAR(fast.inside, slow.inside, 2e-5);
      EXPECT_LT(slow.all, 0.99);
      EXPECT_GT(slow.all, 0.5);
    }
  }
}

BytePicture rowsOf(const BytePicture& picture, int top, int count) {
  BytePicture rows({picture.width(), count}, picture.channels());
  for (int y = 0; y < count; ++y)
    std::copy_n(picture.row(top + y).begin(), picture.row(0).size(), rows.row(y).begin());
  return rows;
}

TEST(Ssim, DoesNotDependOnHowTheRowsArrive) {
  for (const Size size : {Size{30, 45}, Size{12, 11}, Size{14, 7}, Size{9, 1}}) {
    const BytePicture a = noise(size, 3, 8), b = noise(size, 3, 9);
    std::vector<std::uint8_t> inside(size.pixels());
    for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = i % 4 != 1;
    const Ssim whole = structuralSimilarity(a, b, inside);
    for (const int step : {1, 2, 8, 10, 11, 12, 44}) {
      SsimScan scan(size);
      for (int y = 0; y < size.height; y += step) {
        const int count = std::min(step, size.height - y);
        scan.addRows(rowsOf(a, y, count), rowsOf(b, y, count), inside);
      }
      EXPECT_EQ(scan.means().all, whole.all) << size.width << "x" << size.height << " by " << step;
      EXPECT_EQ(scan.means().inside, whole.inside) << step;
    }
  }
}

TEST(Ssim, FlatPicturesAtTheEndsOfTheScaleStayExact) {
  // The variance terms cancel here; rounding must not show against C2.
  for (const int value : {0, 3, 254, 255}) {
    BytePicture a = constant({32, 32}, value), b = a;
    b.at(16, 16, 0) = static_cast<std::uint8_t>(value ^ 1);
    const std::vector<std::uint8_t> everywhere(a.size().pixels(), 1);
    EXPECT_NEAR(structuralSimilarity(a, b, {}).all, slowSsim(a, b, everywhere).all, 2e-5) << value;
  }
}

TEST(Ssim, IsOneForIdenticalPictures) {
  const BytePicture a = noise({64, 48}, 3, 3);
  EXPECT_NEAR(structuralSimilarity(a, a, {}).all, 1, 1e-6);
}

TEST(Ssim, OfTwoConstantsIsTheLuminanceTermAlone) {
  for (const auto& [a, b] : {std::pair{100, 120}, std::pair{0, 255}, std::pair{10, 11}}) {
    const double expected = (2.0 * a * b + kSsimC1) / (1.0 * a * a + 1.0 * b * b + kSsimC1);
    EXPECT_NEAR(structuralSimilarity(constant({20, 20}, a), constant({20, 20}, b), {}).all,
                expected, 1e-5)
        << a << " " << b;
  }
}

TEST(Ssim, OfAPictureAndItsNegativeIsNegative) {
  const BytePicture a = noise({64, 64}, 1, 4);
  BytePicture b = a;
  for (auto& sample : b.samples()) sample = static_cast<std::uint8_t>(255 - sample);
  EXPECT_LT(structuralSimilarity(a, b, {}).all, -0.9);
}

TEST(Ssim, DoesNotDependOnWhichPictureIsCalledTheTruth) {
  const BytePicture a = noise({40, 40}, 3, 5), b = noise({40, 40}, 3, 6);
  EXPECT_NEAR(structuralSimilarity(a, b, {}).all, structuralSimilarity(b, a, {}).all, 1e-7);
}

TEST(Ssim, InsideNothingDoesNotExist) {
  const BytePicture a = noise({20, 20}, 1, 7);
  EXPECT_TRUE(std::isnan(
      structuralSimilarity(a, a, std::vector<std::uint8_t>(a.size().pixels(), 0)).inside));
}

TEST(Ssim, WeightsAddUpToOneAndFitThePicture) {
  for (int length = 1; length < 20; ++length) {
    const std::vector<float> weights = ssimWeights(length);
    double sum = 0;
    for (const float weight : weights) sum += weight;
    EXPECT_NEAR(sum, 1, 1e-6) << length;
    EXPECT_EQ(weights.size() % 2, 1u) << length;
    EXPECT_LE(weights.size(), static_cast<std::size_t>(length));
  }
  EXPECT_EQ(ssimWeights(100).size(), 11u);
  // The ratio of neighbours in the middle of a Gaussian: exp(-1 / (2 sigma^2)).
  EXPECT_NEAR(ssimWeights(11)[4] / ssimWeights(11)[5], std::exp(-1 / 4.5), 1e-6);
}

TEST(Ssim, LumaIsThatOfBt709) {
  BytePicture picture({4, 1}, 3);
  const std::vector<std::uint8_t> rgb{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  std::copy(rgb.begin(), rgb.end(), picture.samples().begin());
  std::vector<float> luma(4);
  lumaRow(picture, 0, luma);
  EXPECT_NEAR(luma[0], 0.2126 * 255, 1e-4);
  EXPECT_NEAR(luma[1], 0.7152 * 255, 1e-4);
  EXPECT_NEAR(luma[2], 0.0722 * 255, 1e-4);
  EXPECT_NEAR(luma[3], 255, 1e-3);
}

}  // namespace
}  // namespace illum
