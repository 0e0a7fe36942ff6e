#include "fit/orthonormal.h"

#include <gtest/gtest.h>

#include "fit/bases/light_basis_family.h"
#include "fit/coefficient_fit.h"
#include "fit/test_lights.h"

namespace illum {
namespace {

Matrix positiveDefinite(int n) {
  const Matrix a = Matrix::Random(n, 2 * n);
  return a * a.transpose();
}

TEST(OrthonormalRotation, MakesFunctionsOrthonormalAndPlanesUncorrelated) {
  const Matrix gram = positiveDefinite(12), covariance = positiveDefinite(12);
  const PlaneRotation rotation = orthonormalRotation(gram, covariance);
  const Matrix functions = rotation.functionsFromOld * gram * rotation.functionsFromOld.transpose();
  EXPECT_LT((functions - Matrix::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-3);
  const Matrix planes = rotation.planesFromOld * covariance * rotation.planesFromOld.transpose();
  const Vector variances = planes.diagonal();
  EXPECT_LT((planes - Matrix(variances.asDiagonal())).cwiseAbs().maxCoeff(), 1e-9 * variances[0]);
  for (int k = 1; k < 12; ++k) EXPECT_LE(variances[k], variances[k - 1]) << k;
}

TEST(OrthonormalRotation, KeepsThePicture) {
  const PlaneRotation rotation = orthonormalRotation(positiveDefinite(9), positiveDefinite(9));
  const Matrix product = rotation.functionsFromOld.transpose() * rotation.planesFromOld;
  EXPECT_LT((product - Matrix::Identity(9, 9)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(OrthonormalRotation, FunctionsThatAreNotSeenDoNotBlowUp) {
  Matrix gram = Matrix::Identity(4, 4);
  gram(3, 3) = 0;
  const PlaneRotation rotation = orthonormalRotation(gram, Matrix::Identity(4, 4));
  EXPECT_TRUE(rotation.functionsFromOld.allFinite());
  EXPECT_LT(rotation.functionsFromOld.cwiseAbs().maxCoeff(), 2e3);
}

TEST(GramOverDomain, OfHemisphericalHarmonicsOverTheHemisphereIsTheIdentity) {
  const auto nodes = capQuadrature(1.5707963267948966, 24);
  std::vector<Direction> directions;
  for (const WeightedDirection& node : nodes) directions.push_back(node.direction);
  const auto basis = analyticBasis(BasisFamily::HemisphericalHarmonics, 16);
  // The functions' integrals are 1, and the mean over 2 pi steradians is what is asked for.
  const Matrix gram = 2 * 3.14159265358979 * gramOverDomain(valuesAt(*basis, directions), nodes);
  EXPECT_LT((gram - Matrix::Identity(16, 16)).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace illum
