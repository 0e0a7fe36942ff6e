#include "fit/projection.h"

#include <algorithm>
#include <cassert>
#include <numbers>

#include "fit/extension.h"
#include "fit/light_weights.h"
#include "illum/error.h"

namespace illum {

std::vector<double> projectionOperator(std::span<const Direction> lights,
                                       const AnalyticBasis& basis, bool extension) {
  assert(!lights.empty());
  if (basis.name() == "dct") {
    throw Error(
        Fault::Usage,
        "projection: expected a basis that is orthonormal over directions (sh or hsh), found "
        "dct");
  }
  const bool hemispherical = basis.name() == "hsh";
  Extension below;
  if (extension && !hemispherical) below = extendBelowHorizon(lights);
  std::vector<Direction> nodes(lights.begin(), lights.end());
  nodes.insert(nodes.end(), below.directions.begin(), below.directions.end());
  LitCap cap = litCapOf(nodes);
  if (hemispherical) cap.thetaMaxRadians = std::min(cap.thetaMaxRadians, std::numbers::pi / 2);
  const std::vector<double> weights = solidAngleWeights(nodes, cap);

  const std::size_t coefficients = static_cast<std::size_t>(basis.coefficients());
  std::vector<double> rows(coefficients * lights.size(), 0.0), values(coefficients);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    basis.evaluate(nodes[i], values);
    for (std::size_t k = 0; k < coefficients; ++k) {
      double* row = rows.data() + k * lights.size();
      const double share = weights[i] * values[k];
      if (i < lights.size()) {
        row[i] += share;
        continue;
      }
      const std::span<const double> samples = below.row(i - lights.size());
      for (std::size_t l = 0; l < lights.size(); ++l) row[l] += share * samples[l];
    }
  }
  return rows;
}

}  // namespace illum
