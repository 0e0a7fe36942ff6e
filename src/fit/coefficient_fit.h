// Which coefficients to fit for a basis of closed form, and how: everything is chosen by
// leave-one-out.
#pragma once

#include <span>
#include <string>

#include "fit/bases/light_basis_family.h"
#include "fit/dense.h"

namespace illum {

/// How coefficients come from samples.
struct CoefficientMethod {
  bool projection =
      false;  ///< of the integral, instead of least squares; then the rest but extension is unused
  bool solidAngleWeights = false;
  bool extension = false;
  bool smooth = false;  ///< penalty by roughness instead of the same for all
  double lambda = 0;

  std::string text() const;
};

/// K x lights: coefficients = operator * samples. `basisAtLights` (lights x K) are the values that
/// the samples are explained by: the basis' own, or its table's.
Matrix coefficientOperator(const AnalyticBasis& basis, const Matrix& basisAtLights,
                           std::span<const Direction> lights, const CoefficientMethod& method);

/// lights x K, closed form.
Matrix valuesAt(const AnalyticBasis& basis, std::span<const Direction> lights);

struct CoefficientChoice {
  CoefficientMethod method;
  Vector errors;  ///< at left-out lights
};

/// The best method by meanDecibels at left-out lights; what the options give is kept. A given
/// regularizer is that of plain ridge regression. `gram`: lights x lights, mean over channels.
CoefficientChoice chooseMethod(const AnalyticBasis& basis, std::span<const Direction> lights,
                               const Matrix& gram, const FitOptions& options);

}  // namespace illum
