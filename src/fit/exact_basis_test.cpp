#include "fit/exact_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "illum/error.h"

namespace illum {
namespace {

const std::vector<DirectionalLight> kLights{{Direction(), {1, 1, 1}},
                                            {Direction::fromVector({1, 0, 1}), {1, 1, 1}},
                                            {Direction::fromVector({0, 1, 1}), {1, 1, 1}},
                                            {Direction::fromVector({0, 0, 1}), {1, 1, 1}},
                                            {Direction::fromVector({-1, -1, 1}), {1, 1, 1}}};

// Of samples that are the same in every channel: one pixel of value l + 1 under light l.
SampleStatistics statistics(std::size_t lights) {
  SampleStatistics s;
  s.lights = static_cast<int>(lights);
  s.pixels = 1;
  for (std::size_t i = 0; i < 3 * lights; ++i) s.mean.push_back(static_cast<double>(i / 3 + 1));
  for (const double a : s.mean)
    for (const double b : s.mean) s.gram.push_back(a * b);
  return s;
}

FitOptions exactOptions() {
  FitOptions options;
  options.family = BasisFamily::Exact;
  return options;
}

TEST(FitExact, KeepsSamplesToTheLastBitAndTheFirstOfSameLights) {
  const Fit fit = fitBasis(kLights, statistics(5), exactOptions());
  EXPECT_EQ(fit.basisName, "exact");
  EXPECT_EQ(fit.coefficients, 4);
  EXPECT_EQ(fit.basis.planes(), 12);
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_NE(fit.warnings[0].find("lights 1 and 4"), std::string::npos);
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  const std::vector<float> one{-0.0F, kTiny, 3e38F};
  std::vector<float> samples;
  for (int i = 0; i < 15; ++i) samples.push_back(one[static_cast<std::size_t>(i) % 3]);
  std::vector<float> planes(12);
  fit.planes.apply(samples, 1, planes);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    EXPECT_EQ(planes[k], one[k % 3]);
    EXPECT_EQ(std::signbit(planes[k]), std::signbit(one[k % 3]));
  }
}

// The third light's picture is interpolated between the others when it is left out: a figure that
// can be worked out by hand only where one light is in the middle of two.
TEST(FitExact, JudgesByLeavingEveryLightOut) {
  std::vector<DirectionalLight> lights{{Direction::fromVector({1, 0, 1}), {1, 1, 1}},
                                       {Direction::fromVector({0, 0, 1}), {1, 1, 1}},
                                       {Direction::fromVector({-1, 0, 1}), {1, 1, 1}}};
  const Fit fit = fitBasis(lights, statistics(3), exactOptions());
  // The middle one is 2, and so is the mean of 1 and 3; it counts as the best that is told apart,
  // 120 dB. Of the others only the sum of both figures can be bounded.
  EXPECT_GT(3 * fit.leaveOneOutDecibels, 120 - 10 * std::log10(16.0));
}

TEST(FitExact, OneLightIsAConstant) {
  const std::vector<DirectionalLight> one(kLights.begin(), kLights.begin() + 1);
  const Fit fit = fitBasis(one, statistics(1), exactOptions());
  std::vector<float> b(fit.basis.evaluateSize());
  fit.basis.evaluate(Direction::fromVector({0.3, -0.2, -0.9}), b);
  EXPECT_FLOAT_EQ(b[0], 1);
}

TEST(FitExact, RefusesOptionsThatLeaveSomethingOut) {
  FitOptions options = exactOptions();
  options.planes = 9;
  EXPECT_THROW(fitBasis(kLights, statistics(5), options), Error);
}

TEST(FitExact, RefusesMoreLightsThanAnObjectHolds) {
  std::vector<DirectionalLight> many;
  for (int i = 0; i < 257; ++i)
    many.push_back({Direction::fromAngles(0.1 + 0.005 * i, 0.7 * i), {1, 1, 1}});
  EXPECT_THROW(fitBasis(many, statistics(257), exactOptions()), Error);
}

}  // namespace
}  // namespace illum
