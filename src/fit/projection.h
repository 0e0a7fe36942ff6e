// Direct projection: the integral of the paper's section 4.1 as one linear step on the samples.
#pragma once

#include <span>
#include <vector>

#include "fit/bases/light_basis_family.h"
#include "illum/vector.h"

namespace illum {

/// Row-major coefficients x lights: coefficient k = sum_i P(k, i) sample_i, the integral of sample
/// times basis function with the lights' solid angles as weights. For light sets that cover their
/// domain evenly (full grids); the functions must be orthonormal there, as SH on the sphere and HSH
/// on the hemisphere are. With `extension` the part of the sphere that is not lit contributes by
/// extendBelowHorizon; without it, as if the samples were 0 there.
std::vector<double> projectionOperator(std::span<const Direction> lights,
                                       const AnalyticBasis& basis, bool extension);

}  // namespace illum
