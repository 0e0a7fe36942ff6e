#include "fit/least_squares.h"

#include <gtest/gtest.h>

#include "fit/coefficient_fit.h"
#include "fit/leave_one_out.h"
#include "fit/test_lights.h"

namespace illum {
namespace {

TEST(LeastSquares, PlainRidgeIsTheTextbookFormula) {
  const std::vector<Direction> lights = test::randomLights(40, 0.1);
  const auto basis = analyticBasis(BasisFamily::SphericalHarmonics, 9);
  const Matrix b = valuesAt(*basis, lights);
  const CoefficientMethod ridge{.lambda = 1e-3};
  const Matrix normal =
      b.transpose() * b + 1e-3 * (b.transpose() * b).trace() / 9 * Matrix::Identity(9, 9);
  const Matrix expected = normal.inverse() * b.transpose();
  const Matrix actual = coefficientOperator(*basis, b, lights, ridge);
  EXPECT_LT((actual - expected).cwiseAbs().maxCoeff(), 1e-10);
}

class EveryFamily : public testing::TestWithParam<BasisFamily> {};

TEST_P(EveryFamily, FunctionsInTheSpanComeBackExactly) {
  const std::vector<Direction> lights = test::randomLights(60, 0.05);
  const auto basis = analyticBasis(GetParam(), 16);
  const Matrix b = valuesAt(*basis, lights);
  for (const bool weights : {false, true}) {
    const CoefficientMethod exact{.solidAngleWeights = weights};
    const Matrix identity = coefficientOperator(*basis, b, lights, exact) * b;
    EXPECT_LT((identity - Matrix::Identity(16, 16)).cwiseAbs().maxCoeff(), 1e-7)
        << basis->name() << (weights ? " weighted" : "");
  }
}

TEST_P(EveryFamily, SmoothnessLeavesConstantsAlone) {
  const std::vector<Direction> lights = test::randomLights(30, 0.05);
  const auto basis = analyticBasis(GetParam(), 9);
  const Matrix b = valuesAt(*basis, lights);
  for (const bool extension : {false, true}) {
    const CoefficientMethod method{.extension = extension, .smooth = true, .lambda = 0.1};
    const Vector fitted = b * (coefficientOperator(*basis, b, lights, method) * Vector::Ones(30));
    EXPECT_LT((fitted - Vector::Ones(30)).cwiseAbs().maxCoeff(), 1e-6)
        << basis->name() << (extension ? " extended" : "");
  }
}

TEST_P(EveryFamily, TheChoiceIsTheBestOfWhatIsLeftOpen) {
  const std::vector<Direction> lights = test::randomLights(30, 0.05);
  const auto basis = analyticBasis(GetParam(), 9);
  const Matrix gram = test::randomGram(30);
  const double best = meanDecibels(chooseMethod(*basis, lights, gram, {}).errors);
  for (const double lambda : {1e-6, 1e-3, 1.0}) {
    FitOptions options;
    options.regularizer = lambda;
    options.extension = false;
    const CoefficientChoice given = chooseMethod(*basis, lights, gram, options);
    EXPECT_EQ(given.method.lambda, lambda);
    EXPECT_FALSE(given.method.smooth);
    EXPECT_FALSE(given.method.extension);
    EXPECT_LE(meanDecibels(given.errors), best + 1e-9) << basis->name() << ", " << lambda;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily,
                         testing::Values(BasisFamily::SphericalHarmonics,
                                         BasisFamily::HemisphericalHarmonics, BasisFamily::Cosine));

TEST(Roughness, OfSphericalHarmonicsIsTheSquaredEigenvalueOfTheLaplacian) {
  const auto basis = analyticBasis(BasisFamily::SphericalHarmonics, 25);
  const Vector rough = roughness(*basis);
  const double scale = rough[2] / 4;  // l = 1: l^2 (l+1)^2 = 4
  EXPECT_NEAR(rough.mean(), 1, 1e-12);
  for (int l = 0, k = 0; l <= 4; ++l) {
    for (int m = -l; m <= l; ++m, ++k) {
      EXPECT_NEAR(rough[k] / scale, l * l * (l + 1) * (l + 1),
                  0.02 * l * l * (l + 1) * (l + 1) + 1e-4)
          << "l " << l << ", m " << m;
    }
  }
}

TEST(Roughness, OfAConstantAloneStillRegularises) {
  EXPECT_EQ(roughness(*analyticBasis(BasisFamily::Cosine, 1))[0], 1);
}

}  // namespace
}  // namespace illum
