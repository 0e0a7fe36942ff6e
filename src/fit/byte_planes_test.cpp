#include "fit/byte_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace illum {
namespace {

struct Figures {
  PlaneOperator planes;
  std::vector<std::uint8_t> bytes;
  std::size_t pixels = 0;

  std::vector<float> ofFloats() const {
    std::vector<float> samples(bytes.size()), out(static_cast<std::size_t>(planes.planes) * pixels);
    for (std::size_t i = 0; i < bytes.size(); ++i) samples[i] = static_cast<float>(bytes[i]) / 255;
    planes.apply(samples, pixels, out);
    return out;
  }
  std::vector<float> ofBytes() const {
    std::vector<float> out(static_cast<std::size_t>(planes.planes) * pixels);
    BytePlanes(planes).apply(bytes, pixels, out);
    return out;
  }
  double sumOfWeights(int plane) const {
    double sum = 0;
    for (int i = 0; i < 3 * planes.lights; ++i)
      sum += std::abs(planes.matrix[static_cast<std::size_t>(plane * 3 * planes.lights + i)]);
    return sum;
  }
};

Figures randomFigures(int planes, int lights, std::size_t pixels) {
  std::mt19937 random(static_cast<unsigned>(100 * planes + lights));
  std::normal_distribution<float> weight(0, 0.1F);
  std::uniform_int_distribution<int> byte(0, 255);
  Figures made{{planes, lights, {}, {}, {}}, {}, pixels};
  for (int i = 0; i < planes * 3 * lights; ++i) made.planes.matrix.push_back(weight(random));
  for (int k = 0; k < planes; ++k) made.planes.offset.push_back(weight(random));
  for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(lights) * pixels; ++i)
    made.bytes.push_back(static_cast<std::uint8_t>(byte(random)));
  return made;
}

TEST(BytePlanes, AreThoseOfTheSameSamplesAsFloats) {
  for (const int lights : {1, 2, 7, 60, 700}) {
    for (const int planes : {1, 5, 6, 7, 18}) {
      for (const std::size_t pixels : {1U, 15U, 16U, 33U, 64U}) {
        const Figures figures = randomFigures(planes, lights, pixels);
        const std::vector<float> expected = figures.ofFloats(), found = figures.ofBytes();
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const double all = figures.sumOfWeights(static_cast<int>(i / pixels));
          ASSERT_NEAR(found[i], expected[i], 2e-5 * all)
              << lights << " lights, plane " << i / pixels << ", pixel " << i % pixels;
        }
      }
    }
  }
}

// Rounding the weights costs far less than rounding the samples to bytes has cost already.
TEST(BytePlanes, AreRoundedFarLessThanTheirSamples) {
  const Figures figures = randomFigures(12, 60, 2000);
  const std::vector<float> expected = figures.ofFloats(), found = figures.ofBytes();
  for (std::size_t k = 0; k < 12; ++k) {
    double error = 0, weights = 0;
    for (std::size_t p = 0; p < figures.pixels; ++p)
      error += std::pow(found[k * figures.pixels + p] - expected[k * figures.pixels + p], 2);
    for (std::size_t i = 0; i < 180; ++i)
      weights += std::pow(figures.planes.matrix[k * 180 + i], 2);
    const double rounded = std::sqrt(weights / 12) / 255;
    EXPECT_LT(std::sqrt(error / static_cast<double>(figures.pixels)), rounded / 30) << k;
  }
}

TEST(BytePlanes, HoldTheLargestSumsThatThereAre) {
  for (const int lights : {1, 86, 1000}) {
    Figures figures{{2, lights, {}, {0.5F, 0}, {}}, {}, 20};
    const std::size_t inner = 3 * static_cast<std::size_t>(lights);
    figures.planes.matrix.assign(inner, 1);
    figures.planes.matrix.insert(figures.planes.matrix.end(), inner, -1);
    figures.bytes.assign(inner * figures.pixels, 255);
    const std::vector<float> found = figures.ofBytes();
    const auto sum = static_cast<float>(inner);
    EXPECT_NEAR(found[0], sum + 0.5F, 1e-3F * sum);
    EXPECT_NEAR(found[20], -sum, 1e-3F * sum);
  }
}

TEST(BytePlanes, OfNoWeightAreTheirOffset) {
  Figures figures{{1, 1, {0, 0, 0}, {0.25F}, {}}, {1, 2, 3}, 1};
  EXPECT_EQ(figures.ofBytes(), std::vector<float>{0.25F});
}

TEST(BytePlanes, DoNotDependOnHowPixelsAreCutIntoBlocks) {
  const Figures whole = randomFigures(7, 20, 100);
  const std::vector<float> expected = whole.ofBytes();
  for (const std::size_t block : {1U, 3U, 20U, 50U}) {
    for (std::size_t begin = 0; begin < whole.pixels; begin += block) {
      Figures part{whole.planes, {}, std::min(block, whole.pixels - begin)};
      for (std::size_t i = 0; i < 60; ++i) {
        const auto row = whole.bytes.begin() + static_cast<std::ptrdiff_t>(i * 100 + begin);
        part.bytes.insert(part.bytes.end(), row, row + static_cast<std::ptrdiff_t>(part.pixels));
      }
      const std::vector<float> found = part.ofBytes();
      for (std::size_t k = 0; k < 7; ++k)
        for (std::size_t p = 0; p < part.pixels; ++p)
          ASSERT_EQ(found[k * part.pixels + p], expected[k * 100 + begin + p]);
    }
  }
}

}  // namespace
}  // namespace illum
