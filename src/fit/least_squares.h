// Penalised least squares: coefficients from samples under scattered lights.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fit/bases/light_basis_family.h"
#include "fit/dense.h"

namespace illum {

/// What is minimised per pixel over the coefficients c, s the samples:
///   sum_i w_i (b_i c - s_i)^2 + sum_m v_m (b'_m c - (E s)_m)^2 + lambda * scale * sum_k penalty_k
///   c_k^2
/// with scale = (trace of the data's normal matrix) / K. w = 1, no virtual lights and penalty = 1
/// are plain ridge regression.
struct LeastSquares {
  Matrix basis;           ///< lights x K
  Vector weights;         ///< lights, or empty for 1
  Matrix virtualBasis;    ///< virtual lights x K; no rows: no extension
  Matrix extension;       ///< virtual lights x lights: E
  Vector virtualWeights;  ///< as weights
  Vector penalty;         ///< K

  /// Normal equations without the penalty.
  Matrix normalMatrix() const;
  Matrix rightSide() const;  ///< K x lights
};

/// K x lights: c = operator * s.
Matrix leastSquaresOperator(const Matrix& normalMatrix, const Matrix& rightSide,
                            const Vector& penalty, double lambda);

/// How rough each function is: the integral over its domain of (Laplacian b_k)^2, scaled to a mean
/// of 1; l^2 (l+1)^2 for spherical harmonics, up to that scale. 0 for constants, so that a penalty
/// with it leaves them alone. All 1 where no function is rough.
Vector roughness(const AnalyticBasis& basis);

}  // namespace illum
