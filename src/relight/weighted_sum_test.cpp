#include "relight/weighted_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "basis/light_sum.h"
#include "illum/colour.h"

namespace illum {
namespace {

constexpr int kPlanes = 6;

LightBasis makeBasis() {
  BasisTable table(LightDomain::Hemisphere, 17, 3 * kPlanes + 3);
  table.fill([](Direction d, std::span<double> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double a = 0.3 * static_cast<double>(i);
      out[i] = std::cos(a) * d.x() + std::sin(a) * d.y() + 0.2 * d.z();
    }
  });
  return LightBasis(table, {BasisColour::Kind::Full, {}});
}

CodingEntry makeCoding(Curve curve) {
  CodingEntry coding;
  coding.curve = curve;
  coding.step = 0.004;
  coding.functions = {0, 0, 1, 2, 3, 4, 5};
  coding.offsets = {-0.1, 0, -0.5, -0.3, -0.2, -0.45, -0.5};
  return coding;
}

PlaneCodes makeCodes(Size tile) {
  PlaneCodes codes{7, tile, std::vector<std::uint16_t>(7 * tile.pixels())};
  std::mt19937 random(3);
  for (auto& v : codes.values) v = static_cast<std::uint16_t>(random() % 256);
  return codes;
}

// The common form, written as it stands in the design, in double, texel by texel.
std::array<double, 3> slowColour(const PlaneCodes& codes, const CodingEntry& coding,
                                 const LightBasis& basis, Direction d, std::size_t texel) {
  std::vector<float> b(basis.evaluateSize());
  basis.evaluate(d, b);
  std::array<double, 3> sum{};
  for (std::size_t c = 0; c < 3; ++c) sum[c] = b[3 * kPlanes + c];
  for (std::size_t p = 0; p < coding.functions.size(); ++p) {
    const double s = coding.offsets[p] + coding.step * codes.plane(static_cast<int>(p))[texel];
    const double value = coding.curve == Curve::Linear ? s : s * std::abs(s);
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += value * b[3 * static_cast<std::size_t>(coding.functions[p]) + c];
    }
  }
  return sum;
}

TEST(WeightedSum, EqualsTheCommonForm) {
  const auto basis = makeBasis();
  const Size tile{61, 43};  // 2623 texels: two whole blocks and a rest
  const auto codes = makeCodes(tile);
  const auto d = Direction::fromVector({0.3, -0.4, 0.8});
  for (const Curve curve : {Curve::Linear, Curve::SignedSqrt}) {
    const auto coding = makeCoding(curve);
    std::vector<float> rgb(3 * (tile.pixels() - 5));
    weightedSum(codes, coding, foldWeights(basis, coding, d), 5, rgb);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
      const auto expected = slowColour(codes, coding, basis, d, i + 5);
      for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(rgb[3 * i + c], expected[c], 2e-5) << i;
    }
  }
}

TEST(WeightedSum, ALightSetCostsOnePassAndIsTheSumOfItsLights) {
  const auto basis = makeBasis();
  const auto coding = makeCoding(Curve::Linear);
  const Size tile{16, 16};
  const auto codes = makeCodes(tile);
  const DirectionalLight a{Direction::fromVector({1, 0, 1}), {0.5f, 0.2f, 3}};
  const DirectionalLight b{Direction::fromVector({-1, 2, 1}), {1, 0, 0.25f}};
  std::vector<float> one(3 * 256), two(3 * 256), both(3 * 256);
  LightSum set(basis.table().domain(), basis.table().resolution());
  set.add(a.toLight, a.intensity);
  set.add(b.toLight, b.intensity);
  weightedSum(codes, coding, foldWeights(basis, coding, a.toLight), 0, one);
  weightedSum(codes, coding, foldWeights(basis, coding, b.toLight), 0, two);
  weightedSum(codes, coding, foldWeights(set.weights(basis), coding), 0, both);
  const std::array<float, 3> ofA{0.5f, 0.2f, 3}, ofB{1, 0, 0.25f};
  for (std::size_t i = 0; i < both.size(); ++i)
    EXPECT_NEAR(both[i], ofA[i % 3] * one[i] + ofB[i % 3] * two[i], 1e-5) << i;
}

TEST(ApplyResponse, DisplayClampsAndDecodes) {
  std::vector<float> samples{-0.5f, 0.0f, 0.5f, 1.0f, 1.5f};
  applyResponse(Response::Display, samples);
  EXPECT_EQ(samples[0], 0);
  EXPECT_NEAR(samples[2], linearFromDisplay(0.5f), 1e-7);
  EXPECT_EQ(samples[3], samples[4]);
  EXPECT_NEAR(samples[4], 1, 1e-6);
}

TEST(ApplyResponse, LinearKeepsAndConeCutsNegativeLight) {
  std::vector<float> samples{-2, 3};
  applyResponse(Response::Linear, samples);
  EXPECT_EQ(samples, (std::vector<float>{-2, 3}));
  applyResponse(Response::Cone, samples);
  EXPECT_EQ(samples, (std::vector<float>{0, 3}));
}

}  // namespace
}  // namespace illum
