// Direct projection: the integral of the paper's section 4.1 as one linear step on the samples.
#pragma once

#include <span>
#include <vector>

#include "fit/bases/light_basis_family.h"
#include "illum/vector.h"

namespace illum {

/// Row-major coefficients x lights: coefficient k = sum_i P(k, i) sample_i, the integral over the
/// sphere of sample times basis function with solid angles (solidAngleWeights) as quadrature
/// weights. For light sets that cover their domain evenly (polar grids, lattices); the basis must
/// be orthonormal with respect to solid angle, as SH on the sphere and HSH on the hemisphere are.
/// With `extension` the unlit part of the sphere contributes by extendBelowHorizon; without it, as
/// if samples were 0 there. HSH end at the horizon and have no use for it: ignored. Throws Error
/// (Fault::Usage) for cosines, which are orthonormal on the chart's square only.
std::vector<double> projectionOperator(std::span<const Direction> lights,
                                       const AnalyticBasis& basis, bool extension);

}  // namespace illum
