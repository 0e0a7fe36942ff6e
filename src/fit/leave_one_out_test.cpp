#include "fit/leave_one_out.h"

#include <gtest/gtest.h>

#include <vector>

#include "fit/least_squares.h"
#include "fit/test_lights.h"

namespace illum {
namespace {

TEST(LeaveOneOut, DecibelsAreThoseOfThePsnr) {
  EXPECT_DOUBLE_EQ(meanDecibels(Vector::Constant(4, 0.01)), 20);
  Vector errors(2);
  errors << 0.1, 0.001;
  EXPECT_DOUBLE_EQ(meanDecibels(errors), 20);
  EXPECT_DOUBLE_EQ(meanDecibels(Vector::Zero(3)), 120) << "rounding is no error";
}

TEST(LeaveOneOut, UsedErrorsOfTheIdentityAreZero) {
  EXPECT_EQ(usedErrors(Matrix::Identity(5, 5), test::randomGram(5)).maxCoeff(), 0);
}

TEST(LeaveOneOut, UsedErrorsAreThoseOfSamples) {
  const Matrix samples = Matrix::Random(6, 40), smoother = Matrix::Random(6, 6);
  const Vector direct = (samples - smoother * samples).rowwise().squaredNorm() / 40;
  const Vector fromMoments = usedErrors(smoother, samples * samples.transpose() / 40);
  EXPECT_LT((direct - fromMoments).cwiseAbs().maxCoeff(), 1e-12);
}

// Fits again without each light in turn, the penalty as it was.
Vector refittedErrors(const Matrix& basis, const Vector& weights, const Matrix& penalty,
                      const Matrix& samples) {
  Vector errors(basis.rows());
  for (Eigen::Index left = 0; left < basis.rows(); ++left) {
    Vector w = weights;
    w[left] = 0;
    const Matrix normal = basis.transpose() * w.asDiagonal() * basis + penalty;
    const Matrix coefficients = normal.ldlt().solve(basis.transpose() * w.asDiagonal() * samples);
    const Matrix error = samples.row(left) - basis.row(left) * coefficients;
    errors[left] = error.squaredNorm() / static_cast<double>(samples.cols());
  }
  return errors;
}

TEST(LeaveOneOut, ClosedFormIsWhatFittingAgainGives) {
  const std::vector<Direction> lights = test::randomLights(30, 0.1);
  const auto harmonics = analyticBasis(BasisFamily::SphericalHarmonics, 16);
  Matrix basis(30, 16);
  std::vector<double> row(16);
  for (int i = 0; i < 30; ++i) {
    harmonics->evaluate(lights[i], row);
    for (int k = 0; k < 16; ++k) basis(i, k) = row[k];
  }
  const Matrix samples = Matrix::Random(30, 50);
  const Vector weights = Vector::Random(30).array().abs() + 0.5;
  for (const double lambda : {1e-4, 1e-2, 1.0}) {
    const Matrix penalty = lambda * Matrix::Identity(16, 16);
    const Matrix normal = basis.transpose() * weights.asDiagonal() * basis + penalty;
    const Matrix smoother =
        basis * normal.ldlt().solve(Matrix(basis.transpose() * weights.asDiagonal()));
    const Vector closed = leaveOneOutErrors(smoother, samples * samples.transpose() / 50);
    const Vector direct = refittedErrors(basis, weights, penalty, samples);
    EXPECT_LT(((closed - direct).array() / direct.array()).abs().maxCoeff(), 1e-7) << lambda;
  }
}

TEST(LeaveOneOut, ALightThatDeterminesItselfIsNotJudgedWell) {
  const Vector errors = leaveOneOutErrors(Matrix::Identity(3, 3), test::randomGram(3));
  EXPECT_TRUE(std::isinf(errors.minCoeff()));
}

}  // namespace
}  // namespace illum
