// Errors at lights that a fit has not seen, from second moments alone.
#pragma once

#include "fit/dense.h"

namespace illum {

/// The criterion that everything is chosen by: the mean over lights of 10 log10(1 / mse), which is
/// what `evaluate` reports but for clamping and rounding.
double meanDecibels(const Vector& meanSquareErrors);

/// Per light, the mean square error of prediction = smoother * samples at the lights themselves:
/// diag((I - H) G (I - H)^T). `gram` is lights x lights, the mean over channels.
Vector usedErrors(const Matrix& smoother, const Matrix& gram);

/// The same when light i's sample is left out. Exact for penalised least squares with fixed weights
/// (Allen's PRESS 1974; Craven and Wahba 1979, lemma 3.2): residual i divided by 1 - H_ii. Where
/// samples pass through another step first (extension, projection), it is the error after sample i
/// has been replaced by its own prediction. Infinite where H_ii = 1: the light determines itself.
Vector leaveOneOutErrors(const Matrix& smoother, const Matrix& gram);

}  // namespace illum
