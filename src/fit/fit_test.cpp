#include "fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "fit/bases/light_basis_family.h"
#include "fit/light_weights.h"
#include "fit/test_lights.h"
#include "fit/test_stack.h"
#include "illum/error.h"

namespace illum {
namespace {

constexpr int kPixels = 300;

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Fitted {
  Fit fit;
  std::vector<float> samples, planes;
};

Fitted fitted(const std::vector<Direction>& lights, const FitOptions& options,
              std::vector<float> samples) {
  Fitted result;
  const int count = static_cast<int>(lights.size());
  result.fit = fitBasis(test::asLights(lights), test::statisticsOf(samples, count), options);
  const std::size_t pixels = samples.size() / (3 * lights.size());
  result.planes.resize(static_cast<std::size_t>(result.fit.basis.planes()) * pixels);
  result.fit.planes.apply(samples, pixels, result.planes);
  result.samples = std::move(samples);
  return result;
}

Fitted fitted(const std::vector<Direction>& lights, const FitOptions& options) {
  return fitted(lights, options, test::shinySamples(lights, kPixels));
}

// 3 x pixels: the picture under a light, through table and planes as a reader computes it.
Rows relit(const Fitted& f, Direction d) {
  const int count = f.fit.basis.planes();
  const auto pixels = static_cast<Eigen::Index>(f.planes.size()) / count;
  std::vector<float> b(f.fit.basis.evaluateSize());
  f.fit.basis.evaluate(d, b);
  const Rows weights = Eigen::Map<const Rows>(b.data(), count + 1, 3).transpose();
  Rows picture = weights.leftCols(count) * Eigen::Map<const Rows>(f.planes.data(), count, pixels);
  picture.colwise() += weights.col(count);
  return picture;
}

double rmsDifference(const Rows& a, const Rows& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<float>(a.size()));
}

Rows truth(Direction d) {
  const std::vector<float> samples = test::shinySamples({d}, kPixels);
  return Eigen::Map<const Rows>(samples.data(), 3, kPixels);
}

FitOptions of(BasisFamily family, int coefficients = 0) {
  FitOptions options;
  options.family = family;
  options.coefficients = coefficients;
  return options;
}

// Lights within 45 degrees of the axis say nothing of lights at the horizon. Noise in the
// photographs must not become light there.
TEST(FitLearned, BeyondANarrowCapLightsFadeAsTheCosine) {
  const std::vector<Direction> lights = test::randomLights(90, std::cos(0.7));
  std::vector<float> samples = test::shinySamples(lights, kPixels);
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.02F);
  for (float& s : samples) s += noise(random);
  FitOptions options;
  options.regularizer = 1e-3;
  const Fitted linear = fitted(lights, options, samples);
  options.displayReferred = true;
  const Fitted display = fitted(lights, options, samples);
  constexpr double kEdge = 1.0, kFar = 1.45;  // radians, both beyond a spacing from the last light
  for (const double phi : {-3.0, -1.0, 0.5, 2.5}) {
    const Direction edge = Direction::fromAngles(kEdge, phi),
                    far = Direction::fromAngles(kFar, phi);
    const double share = std::cos(kFar) / std::cos(kEdge);
    const Rows expected = static_cast<float>(share) * relit(linear, edge);
    EXPECT_LT(rmsDifference(relit(linear, far), expected), 0.01) << phi;
    const Rows encoded = static_cast<float>(std::pow(share, 1 / 2.2)) * relit(display, edge);
    EXPECT_LT(rmsDifference(relit(display, far), encoded), 0.01) << phi;
    // Between the lights nothing changes but the table, which is sampled as finely as it needs.
    const Direction inside = Direction::fromAngles(0.4, phi);
    EXPECT_LT(rmsDifference(relit(linear, inside), relit(display, inside)), 3e-3) << phi;
  }
}

class EveryFit : public testing::TestWithParam<BasisFamily> {};
INSTANTIATE_TEST_SUITE_P(Families, EveryFit,
                         testing::Values(BasisFamily::Learned, BasisFamily::SphericalHarmonics,
                                         BasisFamily::HemisphericalHarmonics, BasisFamily::Cosine));

TEST_P(EveryFit, RelightsUnderUnseenLights) {
  const Fitted f = fitted(test::randomLights(60, 0.1), of(GetParam()));
  double error = 0;
  for (const Direction& d : test::randomLights(20, 0.3, 11))
    error += rmsDifference(relit(f, d), truth(d));
  EXPECT_LT(error / 20, 0.04) << testing::PrintToString(f.fit.choices);
  EXPECT_THAT(f.fit.warnings, testing::IsEmpty());
  EXPECT_GT(f.fit.leaveOneOutDecibels, 30);
}

TEST_P(EveryFit, PlanesAreOrthonormalOverTheLitDomain) {
  const std::vector<Direction> lights = test::randomLights(60, 0.1);
  const Fit fit = fitted(lights, of(GetParam())).fit;
  const int count = fit.basis.planes();
  std::vector<float> b(fit.basis.evaluateSize());
  Matrix gram = Matrix::Zero(count, count);
  double sum = 0;
  for (const WeightedDirection& node : litDomainQuadrature(lights)) {
    fit.basis.evaluate(node.direction, b);
    const Matrix rows = Eigen::Map<const Rows>(b.data(), count, 3).cast<double>();
    gram += node.weight * rows * rows.transpose();
    sum += node.weight;
  }
  // The first planes exactly but for the table; of the last, which carry next to nothing, the table
  // stores little more than the sign.
  const Matrix first = (gram / sum).topLeftCorner(6, 6);
  EXPECT_LT((first - Matrix::Identity(6, 6)).cwiseAbs().maxCoeff(), 0.03) << first;
}

TEST_P(EveryFit, PlanesAreUncorrelatedOverPixels) {
  const Fitted f = fitted(test::randomLights(60, 0.1), of(GetParam()));
  const int count = f.fit.basis.planes();
  Matrix planes = Eigen::Map<const Rows>(f.planes.data(), count, kPixels).cast<double>();
  planes.colwise() -= planes.rowwise().mean().eval();
  const Matrix covariance = planes * planes.transpose() / kPixels;
  // Over coefficients, all colours together, where the basis is separable; jointly where it is
  // learned. What is left comes from fitting once more with the rounded table.
  const int stride = GetParam() == BasisFamily::Learned ? 1 : 3;
  double greatest = 0, variance = 0;
  for (int j = 0; j < count; j += stride) {
    for (int k = 0; k <= j; k += stride) {
      const double sum = covariance.block(j, k, stride, stride).trace();
      (j == k ? variance : greatest) = std::max(j == k ? variance : greatest, std::abs(sum));
    }
  }
  EXPECT_LT(greatest, 0.02 * variance);
}

TEST_P(EveryFit, ConstantPicturesStayConstant) {
  const std::vector<Direction> lights = test::randomLights(40, 0.1);
  const Fitted f = fitted(lights, of(GetParam()), std::vector<float>(3 * 40 * 10, 0.5F));
  for (const Direction& d : test::randomLights(10, 0.3, 4)) {
    EXPECT_NEAR(relit(f, d).minCoeff(), 0.5, 2e-3);
    EXPECT_NEAR(relit(f, d).maxCoeff(), 0.5, 2e-3);
  }
}

TEST_P(EveryFit, TheOrderOfTheLightsDoesNotMatter) {
  std::vector<Direction> lights = test::randomLights(40, 0.1);
  const Fitted before = fitted(lights, of(GetParam()));
  std::reverse(lights.begin(), lights.end());
  const Fitted after = fitted(lights, of(GetParam()));
  EXPECT_EQ(before.fit.basis.planes(), after.fit.basis.planes());
  for (const Direction& d : test::randomLights(10, 0, 4)) {
    EXPECT_LT(rmsDifference(relit(before, d), relit(after, d)), 1e-3);
  }
}

TEST_P(EveryFit, IsTheSameInAnyThread) {
  const std::vector<Direction> lights = test::randomLights(30, 0.1);
  const SampleStatistics statistics = test::statisticsOf(test::shinySamples(lights, kPixels), 30);
  const Fit alone = fitBasis(test::asLights(lights), statistics, of(GetParam()));
  std::vector<Fit> together(4);
  tbb::parallel_for(0, 4, [&](int i) {
    together[i] = fitBasis(test::asLights(lights), statistics, of(GetParam()));
  });
  for (const Fit& fit : together) {
    EXPECT_EQ(fit.planes.matrix, alone.planes.matrix);
    EXPECT_EQ(fit.basis.table(), alone.basis.table());
  }
}

TEST_P(EveryFit, FewLightsAndBlackPicturesAreFitted) {
  for (const int count : {1, 2, 3, 5, 8}) {
    const std::vector<Direction> lights = test::randomLights(count, 0.2);
    for (const bool black : {false, true}) {
      std::vector<float> samples = test::shinySamples(lights, 20);
      if (black) std::fill(samples.begin(), samples.end(), 0.0F);
      const Fitted f = fitted(lights, of(GetParam()), samples);
      const Rows picture = relit(f, lights[0]);
      EXPECT_TRUE(picture.allFinite()) << count << " lights" << (black ? ", black" : "");
      EXPECT_LT(picture.cwiseAbs().maxCoeff(), 2) << count << " lights";
    }
  }
}

TEST_P(EveryFit, LightsFromBelowMakeItASphere) {
  if (GetParam() == BasisFamily::HemisphericalHarmonics) GTEST_SKIP() << "defined above only";
  const Fitted f = fitted(test::randomLights(80, -1), of(GetParam()));
  EXPECT_EQ(f.fit.basis.table().domain(), LightDomain::Sphere);
  double error = 0;
  for (const Direction& d : test::randomLights(20, -0.9, 13))
    error += rmsDifference(relit(f, d), truth(d));
  EXPECT_LT(error / 20, 0.06);
}

TEST_P(EveryFit, OneLightTellsNothingOfOthers) {
  const Fitted f = fitted({Direction::fromVector({0.2, 0.1, 0.9})}, of(GetParam(), 0));
  EXPECT_TRUE(std::isnan(f.fit.leaveOneOutDecibels));
}

TEST(Fit, NamedCoefficientsComeBack) {
  const std::vector<Direction> lights = test::randomLights(60, 0.1);
  const Fitted f = fitted(lights, of(BasisFamily::SphericalHarmonics, 9));
  ASSERT_EQ(f.fit.mixing.size(), 81U);
  const auto harmonics = analyticBasis(BasisFamily::SphericalHarmonics, 9);
  std::vector<double> y(9);
  const Direction d = Direction::fromAngles(0.7, 1);
  harmonics->evaluate(d, y);
  const auto& colour = f.fit.basis.colour().colourMatrix;
  Rows picture = Rows::Zero(3, kPixels);
  for (int j = 0; j < 9; ++j) {
    for (int k = 0; k < 9; ++k) {
      for (int c = 0; c < 9; ++c) {
        const double factor = y[j] * f.fit.mixing[9 * j + k] * colour[c];
        const Eigen::Map<const Rows> planes(f.planes.data(), 27, kPixels);
        picture.row(c / 3) += static_cast<float>(factor) * planes.row(3 * k + c % 3);
      }
    }
  }
  EXPECT_LT(rmsDifference(picture, relit(f, d)), 2e-3);
}

TEST(Fit, GreyPhotographsGiveGreyPictures) {
  const std::vector<Direction> lights = test::randomLights(30, 0.1);
  std::vector<float> samples = test::shinySamples(lights, kPixels);
  for (std::size_t l = 0; l < 30; ++l) {
    const auto first = samples.begin() + static_cast<std::ptrdiff_t>(3 * l * kPixels);
    std::copy(first, first + kPixels, first + kPixels);
    std::copy(first, first + kPixels, first + 2 * kPixels);
  }
  for (const BasisFamily family : {BasisFamily::Learned, BasisFamily::SphericalHarmonics}) {
    const Rows picture = relit(fitted(lights, of(family), samples), lights[3]);
    EXPECT_LT((picture.row(0) - picture.row(2)).cwiseAbs().maxCoeff(), 5e-3);
  }
}

TEST(Fit, TooManyCoefficientsAreTold) {
  FitOptions options = of(BasisFamily::SphericalHarmonics, 64);
  options.regularizer = 1e-7;
  const Fit fit = fitted(test::randomLights(30, 0.1), options).fit;
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_THAT(fit.warnings[0], testing::HasSubstr("30 lights cannot support 64 coefficients"));
}

TEST(Fit, TooManyPlanesAreTold) {
  FitOptions options;
  options.planes = 90;
  const Fit fit = fitted(test::randomLights(20, 0.1), options).fit;
  EXPECT_EQ(fit.basis.planes(), 60);
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_THAT(fit.warnings[0], testing::HasSubstr("90 planes asked for"));
}

TEST(Fit, WhatCannotBeFittedIsAnError) {
  const std::vector<Direction> lights = test::randomLights(5, 0.1);
  SampleStatistics statistics = test::statisticsOf(test::shinySamples(lights, 10), 5);
  EXPECT_THROW(fitBasis({}, statistics, {}), Error);
  EXPECT_THROW(fitBasis(test::asLights(test::randomLights(4, 0.1)), statistics, {}), Error);
  EXPECT_THROW(
      fitBasis(test::asLights(lights), statistics, of(BasisFamily::SphericalHarmonics, 10)), Error)
      << "10 is no square";
  FitOptions negative;
  negative.regularizer = -1;
  EXPECT_THROW(fitBasis(test::asLights(lights), statistics, negative), Error);
  statistics.gram[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fitBasis(test::asLights(lights), statistics, {}), Error);
}

TEST(PlaneOperator, IsAMatrixProductPlusAnOffset) {
  PlaneOperator op{2, 1, {1, 2, 3, -1, 0, 4}, {0.5F, -0.5F}, {}};
  const std::vector<float> samples{1, 10, 2, 20, 3, 30};  // three channels of two pixels
  std::vector<float> planes(4);
  op.apply(samples, 2, planes);
  EXPECT_THAT(planes, testing::ElementsAre(14.5F, 140.5F, 10.5F, 109.5F));
  op.apply({}, 0, {});
}

TEST(PlaneOperator, DoesNotDependOnHowPixelsAreCutIntoBlocks) {
  const std::vector<Direction> lights = test::randomLights(40, 0.1);
  const int pixels = 1024;
  const Fitted whole = fitted(lights, {}, test::shinySamples(lights, pixels));
  const int count = whole.fit.planes.planes;
  for (const int block : {16, 64, 512}) {
    std::vector<float> samples(static_cast<std::size_t>(120) * block), planes(count * block);
    for (int begin = 0; begin < pixels; begin += block) {
      for (int row = 0; row < 120; ++row) {
        std::copy_n(whole.samples.begin() + row * pixels + begin, block,
                    samples.begin() + row * block);
      }
      whole.fit.planes.apply(samples, block, planes);
      for (int k = 0; k < count; ++k) {
        for (int p = 0; p < block; ++p) {
          ASSERT_EQ(planes[k * block + p], whole.planes[k * pixels + begin + p])
              << "block of " << block << ", plane " << k << ", pixel " << begin + p;
        }
      }
    }
  }
}

}  // namespace
}  // namespace illum
