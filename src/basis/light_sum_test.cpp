#include "basis/light_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "illum/light.h"

namespace illum {
namespace {

/// A basis whose columns are all different and as rough as its table allows.
LightBasis roughBasis(LightDomain domain, BasisColour::Kind kind) {
  BasisTable table(domain, 9, 6);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1, 1);
  for (float& v : table.values()) v = value(random);
  for (float& v : table.southPole()) v = value(random);
  BasisColour colour;
  colour.kind = kind;
  colour.colourMatrix = {1, 2, 3, 4, 5, 6, 7, 8, 10};
  return {table, colour};
}

std::vector<DirectionalLight> someLights(int count) {
  std::mt19937 random(11);
  std::normal_distribution<double> coordinate;
  std::uniform_real_distribution<float> intensity(0, 2);
  std::vector<DirectionalLight> lights{{Direction::fromVector({0, 0, -1}), {1, 2, 3}},
                                       {Direction::fromVector({1, 0, 0}), {1, 2, 3}}};
  for (int i = 0; i < count; ++i)
    lights.push_back(
        {Direction::fromVector({coordinate(random), coordinate(random), coordinate(random)}),
         {intensity(random), intensity(random), intensity(random)}});
  return lights;
}

class LightSums : public testing::TestWithParam<std::tuple<LightDomain, BasisColour::Kind>> {};

TEST_P(LightSums, GiveWhatEveryLightGivesByItself) {
  const LightBasis basis = roughBasis(std::get<0>(GetParam()), std::get<1>(GetParam()));
  LightSum sum(basis.table().domain(), basis.table().resolution());
  std::vector<double> expected(basis.evaluateSize());
  std::vector<float> one(basis.evaluateSize());
  for (const DirectionalLight& light : someLights(50)) {
    sum.add(light.toLight, light.intensity);
    basis.evaluate(light.toLight, one);
    for (std::size_t i = 0; i < one.size(); i += 3) {
      expected[i] += one[i] * static_cast<double>(light.intensity.r);
      expected[i + 1] += one[i + 1] * static_cast<double>(light.intensity.g);
      expected[i + 2] += one[i + 2] * static_cast<double>(light.intensity.b);
    }
  }
  const std::vector<double> weights = sum.weights(basis);
  ASSERT_EQ(weights.size(), expected.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(weights[i], expected[i], 1e-5 * (1 + std::abs(expected[i]))) << "weight " << i;
}

TEST_P(LightSums, AddUp) {
  const LightBasis basis = roughBasis(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto lights = someLights(10);
  LightSum all(basis.table().domain(), basis.table().resolution()), odd = all, even = all;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    all.add(lights[i].toLight, lights[i].intensity);
    (i % 2 == 0 ? even : odd).add(lights[i].toLight, lights[i].intensity);
  }
  even.add(odd);
  const auto expected = all.weights(basis), weights = even.weights(basis);
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(weights[i], expected[i], 1e-12 * (1 + std::abs(expected[i]))) << "weight " << i;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LightSums,
    testing::Combine(testing::Values(LightDomain::Hemisphere, LightDomain::Sphere),
                     testing::Values(BasisColour::Kind::Separable, BasisColour::Kind::Full)));

}  // namespace
}  // namespace illum
