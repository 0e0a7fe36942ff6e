#include "fit/least_squares.h"

#include <cassert>

namespace illum {
namespace {

// Rows times sqrt of the weight would do as well; this keeps unit weights exact.
Matrix weighted(const Matrix& rows, const Vector& weights) {
  return weights.size() == 0 ? rows : Matrix(weights.asDiagonal() * rows);
}

}  // namespace

Matrix LeastSquares::normalMatrix() const {
  Matrix normal = basis.transpose() * weighted(basis, weights);
  if (virtualBasis.rows() > 0) {
    normal += virtualBasis.transpose() * weighted(virtualBasis, virtualWeights);
  }
  return normal;
}

Matrix LeastSquares::rightSide() const {
  Matrix right = weighted(basis, weights).transpose();
  if (virtualBasis.rows() > 0) {
    right += weighted(virtualBasis, virtualWeights).transpose() * extension;
  }
  return right;
}

Matrix leastSquaresOperator(const Matrix& normalMatrix, const Matrix& rightSide,
                            const Vector& penalty, double lambda) {
  assert(penalty.size() == normalMatrix.rows());
  const double scale = normalMatrix.trace() / static_cast<double>(normalMatrix.rows());
  Matrix regular = normalMatrix;
  regular.diagonal() += lambda * scale * penalty;
  return solveSymmetric(regular, rightSide);
}

Vector roughness(const AnalyticBasis& basis) {
  // The stereographic chart is conformal: with u = 2x-1, v = 2y-1 the sphere's metric is
  // 4 (du^2 + dv^2) / (1 + u^2 + v^2)^2, so that Laplacian = ((1 + u^2 + v^2)^2 / 16) (d_xx +
  // d_yy).
  constexpr int kGrid = 48;
  constexpr double kStep = 1e-3;
  const int n = basis.coefficients();
  const int squares = basis.domain() == LightDomain::Sphere ? 2 : 1;
  Vector sum = Vector::Zero(n), curvature(n);
  std::vector<double> values(static_cast<std::size_t>(n));
  const auto add = [&](ChartPoint p, double factor) {
    basis.evaluateOnChart(p, values);
    curvature += factor * Eigen::Map<const Vector>(values.data(), n);
  };
  for (int cell = 0; cell < squares * kGrid * kGrid; ++cell) {
    const int square = cell / (kGrid * kGrid);
    const double x = (cell % kGrid + 0.5) / kGrid, y = (cell / kGrid % kGrid + 0.5) / kGrid;
    const double u = 2 * x - 1, v = 2 * y - 1, stretch = 1 + u * u + v * v;
    if (stretch > 2) continue;
    curvature.setZero();
    add({square, x, y}, -4);
    for (const double side : {-kStep, kStep}) {
      add({square, x + side, y}, 1);
      add({square, x, y + side}, 1);
    }
    const Vector laplacian = stretch * stretch / (16 * kStep * kStep) * curvature;
    const double area = 16 / (stretch * stretch);  // of the sphere, per area of the chart
    sum += area * laplacian.cwiseProduct(laplacian);
  }
  const double mean = sum.mean();
  return mean > 0 ? Vector(sum / mean) : Vector::Ones(n);
}

}  // namespace illum
