#include "build/quantiser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace illum {
namespace {

// Two planes over a basis that is a constant and a slope; the table reproduces both exactly.
Fit makeFit() {
  BasisTable table(LightDomain::Hemisphere, 9, 9);
  table.fill([](Direction d, std::span<double> out) {
    for (int c = 0; c < 3; ++c) {
      out[static_cast<std::size_t>(c)] = 1;
      out[static_cast<std::size_t>(3 + c)] = d.x();
      out[static_cast<std::size_t>(6 + c)] = 0.1;
    }
  });
  Fit fit;
  fit.basis = LightBasis(table, {BasisColour::Kind::Full, {}});
  return fit;
}

std::vector<DirectionalLight> makeLights() {
  std::vector<DirectionalLight> lights;
  for (int i = 0; i < 8; ++i) lights.push_back({Direction::fromAngles(0.7, 0.785 * i), {1, 1, 1}});
  return lights;
}

std::vector<float> makePlanes(std::size_t pixels) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> brightness(0, 0.8f), slope(-0.1f, 0.1f);
  std::vector<float> planes(2 * pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    planes[p] = brightness(random);
    planes[pixels + p] = slope(random);
  }
  return planes;
}

QuantiserChoice choose(Response response, std::span<const float> planes,
                       const QuantiserRequest& request) {
  const QuantiserTrial trial(makeFit(), makeLights(), response, planes, planes.size() / 2, true);
  return chooseQuantiser({&trial, 1}, request);
}

constexpr std::size_t kPixels = 4000;
const Size kSize{80, 50};

TEST(Quantiser, ErrorIsAtMostHalfAStep) {
  const auto planes = makePlanes(kPixels);
  for (const Coding coding : {Coding::Avif, Coding::Jpeg, Coding::Png}) {
    const auto choice =
        choose(Response::Display, planes, {.coding = coding, .bits = {}, .curve = {}});
    ASSERT_EQ(choice.entries[0].curve, Curve::Linear);
    std::uint64_t clipped = 0;
    const auto codes = quantise(choice.entries[0], planes, kSize, clipped);
    EXPECT_EQ(clipped, 0u);
    const auto back = dequantise(choice.entries[0], codes, 2);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      ASSERT_NEAR(back[i], planes[i], 0.501 * choice.entries[0].step) << i;
    }
  }
}

TEST(Quantiser, ReachesItsTargetByStoringAWidePlaneTwice) {
  const auto planes = makePlanes(kPixels);
  const auto choice =
      choose(Response::Display, planes,
             {.coding = Coding::Avif, .bits = {}, .curve = {}, .targetDecibels = 66});
  EXPECT_GE(choice.decibels, 66);
  EXPECT_LE(choice.decibels, 70) << "bytes are spent on precision that nobody asked for";
  EXPECT_EQ(choice.entries[0].bits, 8);
  ASSERT_GT(choice.entries[0].functions.size(), 2u);
  EXPECT_EQ(choice.entries[0].functions[1], 0);
  EXPECT_EQ(choice.entries[0].offsets[1], 0);
}

TEST(Quantiser, GivenBitsAreKept) {
  const auto planes = makePlanes(kPixels);
  double before = 0;
  for (const int bits : {8, 10, 12, 16}) {
    const auto choice = choose(Response::Linear, planes,
                               {.coding = Coding::Png, .bits = bits, .curve = Curve::Linear});
    EXPECT_EQ(choice.entries[0].bits, bits);
    EXPECT_EQ(choice.entries[0].functions.size(), 2u);
    EXPECT_GT(choice.decibels, before + 3) << bits;
    before = choice.decibels;
  }
}

TEST(Quantiser, SignedSqrtIsFinerNearZero) {
  const auto planes = makePlanes(kPixels);
  const auto choice = choose(Response::Linear, planes,
                             {.coding = Coding::Avif, .bits = 8, .curve = Curve::SignedSqrt});
  std::uint64_t clipped = 0;
  const auto back =
      dequantise(choice.entries[0], quantise(choice.entries[0], planes, kSize, clipped), 2);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double root = std::sqrt(std::abs(static_cast<double>(planes[i])));
    const double bound = choice.entries[0].step * (root + choice.entries[0].step);
    ASSERT_NEAR(back[i], planes[i], bound) << planes[i];
  }
}

TEST(Quantiser, ValuesOutsideAreCountedNotHidden) {
  const auto planes = makePlanes(kPixels);
  const auto choice =
      choose(Response::Display, planes, {.coding = Coding::Avif, .bits = {}, .curve = {}});
  std::uint64_t clipped = 0;
  const std::vector<float> wild{-3.0f, 0.5f, 7.0f, 0.0f};
  const auto codes = quantise(choice.entries[0], wild, {2, 1}, clipped);
  EXPECT_EQ(clipped, 2u);
  const auto back = dequantise(choice.entries[0], codes, 2);
  EXPECT_NEAR(back[0], choice.entries[0].offsets[0], 1e-6) << "the least code";
  EXPECT_NEAR(back[2], choice.entries[0].offsets.back() + 255 * choice.entries[0].step, 1e-6)
      << "the greatest code";
}

TEST(Quantiser, BasesShareBitsCurveAndStep) {
  const auto planes = makePlanes(kPixels);
  std::vector<float> wide = planes;
  for (float& value : wide) value *= 5;
  const Fit fit = makeFit();
  const auto lights = makeLights();
  const std::vector<QuantiserTrial> trials{
      {fit, lights, Response::Linear, planes, kPixels, true, 2},
      {fit, lights, Response::Linear, wide, kPixels, true, 2}};
  for (const Coding coding : {Coding::Avif, Coding::Png}) {
    const auto choice = chooseQuantiser(trials, {.coding = coding, .bits = {}, .curve = {}});
    ASSERT_EQ(choice.entries.size(), 2u);
    const CodingEntry &a = choice.entries[0], &b = choice.entries[1];
    EXPECT_EQ(a.bits, b.bits);
    EXPECT_EQ(a.curve, b.curve);
    EXPECT_EQ(a.step, b.step);
    EXPECT_LE(a.functions.size(), b.functions.size());
    std::uint64_t clipped = 0;
    quantise(a, planes, kSize, clipped);
    quantise(b, wide, kSize, clipped);
    EXPECT_EQ(clipped, 0u) << "the step is wide enough for both";
    EXPECT_NEAR(choice.decibels, (trials[0].decibels(a) + trials[1].decibels(b)) / 2, 1e-9);
  }
}

TEST(Quantiser, ConstantPlanesNeedNoRange) {
  const std::vector<float> planes(2 * kPixels, 0.25f);
  const auto choice =
      choose(Response::Display, planes, {.coding = Coding::Avif, .bits = {}, .curve = {}});
  EXPECT_GT(choice.entries[0].step, 0);
  EXPECT_GE(choice.decibels, 50);
}

}  // namespace
}  // namespace illum
