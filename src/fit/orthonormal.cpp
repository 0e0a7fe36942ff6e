#include "fit/orthonormal.h"

#include <cassert>
#include <cmath>

namespace illum {

Matrix gramOverDomain(const Matrix& valuesAtNodes, std::span<const WeightedDirection> nodes) {
  assert(valuesAtNodes.rows() == static_cast<Eigen::Index>(nodes.size()));
  Vector weights(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) weights[i] = nodes[i].weight;
  weights /= weights.sum();
  return valuesAtNodes.transpose() * weights.asDiagonal() * valuesAtNodes;
}

PlaneRotation orthonormalRotation(const Matrix& gram, const Matrix& covariance) {
  const int n = static_cast<int>(gram.rows());
  assert(covariance.rows() == n);
  Matrix regular = gram;
  regular.diagonal().array() += 1e-6 * gram.trace() / n;
  // gram = L L^T: functions L^-1 f are orthonormal, and their planes are L^T P.
  const Eigen::LLT<Matrix> cholesky(regular);
  const Matrix lower = cholesky.matrixL();
  const Matrix whitened = lower.transpose() * covariance * lower;
  const EigenPairs pairs = largestEigenPairs(whitened, n);
  const Matrix functions = lower.triangularView<Eigen::Lower>().solve(Matrix::Identity(n, n));
  return {pairs.vectors.transpose() * lower.transpose(), pairs.vectors.transpose() * functions};
}

}  // namespace illum
