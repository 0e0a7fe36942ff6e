#include "relight/weighted_sum.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <random>

#include "basis/light_mesh.h"
#include "basis/light_sum.h"
#include "illum/colour.h"
#include "relight/passes.h"

// Counts what this program takes from the heap, to hold the inner loops to taking nothing.
namespace {
thread_local std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

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

// Halves of either sign, from the smallest to about 2.
PlaneCodes makeHalves(int planes, Size tile) {
  PlaneCodes codes{planes, tile, {}};
  codes.values.resize(static_cast<std::size_t>(planes) * tile.pixels());
  std::mt19937 random(4);
  for (auto& v : codes.values)
    v = static_cast<std::uint16_t>(random() % 0x4000 | (random() % 2 == 0 ? 0x8000 : 0));
  return codes;
}

CodingEntry makeHalfCoding(int planes) {
  CodingEntry coding;
  coding.coding = Coding::Png;
  coding.bits = 16;
  coding.curve = Curve::Half;
  for (int k = 0; k < planes; ++k) coding.functions.push_back(k);
  coding.offsets.assign(coding.functions.size(), 0);
  return coding;
}

// A separable basis of two functions; its colours are no identity.
LightBasis makeSeparableBasis() {
  BasisTable table(LightDomain::Hemisphere, 9, 2);
  table.fill([](Direction d, std::span<double> out) {
    out[0] = d.z();
    out[1] = d.x() - 0.5 * d.y();
  });
  BasisColour colour;
  colour.colourMatrix = {0.5, 0.5, -0.7, 0.6, -0.1, 0.8, 0.6, 0.9, 0.1};
  return LightBasis(table, colour);
}

// The octahedron, all of whose corners are lights.
LightBasis makeExactBasis() {
  return LightBasis(std::make_shared<const LightMesh>(
      std::vector<Vector3>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, 6,
      std::vector<LightMesh::Triangle>{
          {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}},
      "mesh"));
}

// The common form, written as it stands in the design, in double, texel by texel.
std::array<double, 3> slowColour(const PlaneCodes& codes, const CodingEntry& coding,
                                 const LightBasis& basis, Direction d, std::size_t texel) {
  std::vector<float> b(basis.evaluateSize());
  basis.evaluate(d, b);
  std::array<double, 3> sum{};
  for (std::size_t c = 0; c < 3; ++c) sum[c] = b[b.size() - 3 + c];
  for (std::size_t p = 0; p < coding.functions.size(); ++p) {
    const double value = valueOfCode(coding, p, codes.plane(static_cast<int>(p))[texel]);
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += value * b[3 * static_cast<std::size_t>(coding.functions[p]) + c];
    }
  }
  return sum;
}

// Texels 5 to the last but 2, which no block and no vector divides.
void expectCommonForm(const PlaneCodes& codes, const CodingEntry& coding, const LightBasis& basis,
                      int bits) {
  const auto d = Direction::fromVector({0.3, -0.4, 0.8});
  const FoldedWeights weights = foldWeights(basis, coding, d);
  const TilePlanes planes(codes, bits);
  std::vector<float> rgb(3 * (codes.tile.pixels() - 7) + 3, 77);
  weightedSum(planes, coding, weights, 5, std::span(rgb).first(rgb.size() - 3));
  for (std::size_t i = 0; i + 1 < rgb.size() / 3; ++i) {
    const auto expected = slowColour(codes, coding, basis, d, i + 5);
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(rgb[3 * i + c], expected[c], 2e-5) << i;
  }
  EXPECT_EQ(rgb.back(), 77) << "nothing is written behind the end";
}

constexpr Size kOddTile{61, 43};  // 2623 texels: two whole blocks and a rest

TEST(WeightedSum, EqualsTheCommonForm) {
  const auto codes = makeCodes(kOddTile);
  for (const Curve curve : {Curve::Linear, Curve::SignedSqrt}) {
    const auto coding = makeCoding(curve);
    EXPECT_FALSE(foldWeights(makeBasis(), coding, Direction::fromVector({1, 2, 2})).isSeparable);
    for (const int bits : {8, 16}) expectCommonForm(codes, coding, makeBasis(), bits);
  }
}

TEST(WeightedSum, EqualsTheCommonFormOfHalves) {
  expectCommonForm(makeHalves(6, kOddTile), makeHalfCoding(6), makeBasis(), 16);
  expectCommonForm(makeHalves(18, kOddTile), makeHalfCoding(18), makeExactBasis(), 16);
}

TEST(WeightedSum, EqualsTheCommonFormOfSeparableBases) {
  auto coding = makeCoding(Curve::Linear);
  ASSERT_TRUE(foldWeights(makeSeparableBasis(), coding, Direction()).isSeparable);
  for (const Curve curve : {Curve::Linear, Curve::SignedSqrt}) {
    coding.curve = curve;
    for (const int bits : {8, 16})
      expectCommonForm(makeCodes(kOddTile), coding, makeSeparableBasis(), bits);
  }
}

// Lights of different colours are no longer multiples of one; only the exact basis keeps channels
// apart.
TEST(WeightedSum, SetsOfColouredLightsAreFull) {
  const auto fold = [](const LightBasis& basis, const CodingEntry& coding) {
    LightSum sum(basis);
    sum.add(Direction::fromVector({1, 0, 1}), {1, 0, 0.5F});
    sum.add(Direction::fromVector({0, 1, 1}), {0, 1, 0.25F});
    return foldWeights(sum.weights(basis), coding);
  };
  EXPECT_FALSE(fold(makeSeparableBasis(), makeCoding(Curve::Linear)).isSeparable);
  EXPECT_TRUE(fold(makeExactBasis(), makeHalfCoding(18)).isSeparable);
}

// Not even what is not a number in other pictures, or other channels, is seen.
TEST(WeightedSum, AtItsOwnLightAHalfComesBackToTheLastBit) {
  const auto basis = makeExactBasis();
  const auto coding = makeHalfCoding(18);
  PlaneCodes codes{18, {256, 256}, std::vector<std::uint16_t>(18 * 65536, 0x7e00)};
  const auto own = codes.plane(3 * 2 + 1);  // green under the light at +y: every half there is
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = static_cast<std::uint16_t>(i);
  const TilePlanes planes(codes, 16);
  std::vector<float> rgb(3 * 65536);
  LightSum sum(basis);
  sum.add(Direction::fromVector({0, 2, 0}), {1, 1, 1});
  weightedSum(planes, coding, foldWeights(sum.weights(basis), coding), 0, rgb);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto expected = static_cast<float>(valueOfCode(coding, 0, own[i]));
    const float found = rgb[3 * i + 1];
    if (std::isnan(expected)) {
      ASSERT_TRUE(std::isnan(found)) << i;
    } else {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(found), std::bit_cast<std::uint32_t>(expected)) << i;
    }
  }
}

TEST(WeightedSum, AllocatesNothing) {
  const auto exact = makeExactBasis(), full = makeBasis();
  const auto halves = makeHalfCoding(18), linear = makeCoding(Curve::Linear);
  const TilePlanes ofExact(makeHalves(18, kOddTile), 16), ofFull(makeCodes(kOddTile), 8);
  const DirectionalLight light{Direction::fromVector({1, 2, 3}), {1, 1, 1}};
  const Passes passes[] = {Passes(exact, halves, Response::Linear, {&light, 1}),
                           Passes(full, linear, Response::Linear, {&light, 1}),
                           Passes(full, linear, Response::Display, {&light, 1})};
  std::vector<float> rgb(3 * kOddTile.pixels()), scratch(rgb.size());
  passes[0].relight(ofExact, 0, rgb, scratch);  // chooses the instruction set
  const std::size_t before = allocations;
  passes[0].relight(ofExact, 0, rgb, scratch);
  passes[1].relight(ofFull, 0, rgb, scratch);
  passes[2].relight(ofFull, 0, rgb, scratch);
  EXPECT_EQ(allocations, before);
  EXPECT_NE(std::make_unique<int>(3), nullptr);
  EXPECT_GT(allocations, before) << "the count counts";
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
  const TilePlanes planes(codes, 8);
  weightedSum(planes, coding, foldWeights(basis, coding, a.toLight), 0, one);
  weightedSum(planes, coding, foldWeights(basis, coding, b.toLight), 0, two);
  weightedSum(planes, coding, foldWeights(set.weights(basis), coding), 0, both);
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

TEST(ApplyResponse, DisplayIsTheTransferFunctionEverywhere) {
  constexpr int kSteps = 100'003;
  for (int i = 0; i <= kSteps; ++i) {
    const float display = static_cast<float>(i) / kSteps;
    std::array<float, 1> sample{display};
    applyResponse(Response::Display, sample);
    ASSERT_NEAR(sample[0], linearFromDisplay(display), 1e-7) << display;
  }
  std::vector<float> hostile{std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()};
  applyResponse(Response::Display, hostile);
  EXPECT_EQ(hostile, (std::vector<float>{0, 1, 0}));
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
