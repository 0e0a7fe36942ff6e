// Planes in the form that one common quantiser step is right for.
#pragma once

#include <span>

#include "fit/dense.h"
#include "fit/light_weights.h"

namespace illum {

/// The functions' Gram matrix: mean over the domain of f_j f_k. valuesAtNodes(i, k): function k at
/// node i.
Matrix gramOverDomain(const Matrix& valuesAtNodes, std::span<const WeightedDirection> nodes);

/// new planes = planesFromOld * old planes; new functions = functionsFromOld * old functions, so
/// that sum_k f_k P_k stays what it is.
struct PlaneRotation {
  Matrix planesFromOld;
  Matrix functionsFromOld;  ///< the inverse's transpose
};

/// New functions are orthonormal over the domain whose Gram matrix (of the old functions) is given:
/// an error e_k in the planes then costs sum_k e_k^2 in the picture, averaged over the domain's
/// lights. Among those it is the one whose planes are uncorrelated over pixels (Karhunen-Loeve), of
/// falling variance. `covariance`: of the old planes. A millionth of the mean of the Gram matrix's
/// diagonal is added to it, so that functions that the domain hardly sees do not blow up.
PlaneRotation orthonormalRotation(const Matrix& gram, const Matrix& covariance);

}  // namespace illum
