#include "fit/coefficient_fit.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "fit/extension.h"
#include "fit/least_squares.h"
#include "fit/leave_one_out.h"
#include "fit/light_weights.h"
#include "fit/projection.h"

namespace illum {
namespace {

// The extension's virtual lights where the basis is defined: everywhere for spherical harmonics,
// above the horizon for bases of the hemisphere.
Extension extensionFor(const AnalyticBasis& basis, std::span<const Direction> lights) {
  Extension extension = extendBelowHorizon(lights);
  if (basis.name() == "sh" || basis.domain() == LightDomain::Sphere) return extension;
  Extension upper;
  upper.lights = extension.lights;
  for (std::size_t m = 0; m < extension.directions.size(); ++m) {
    if (extension.directions[m].z() < 0) continue;
    upper.directions.push_back(extension.directions[m]);
    const std::span<const double> row = extension.row(m);
    upper.matrix.insert(upper.matrix.end(), row.begin(), row.end());
  }
  return upper;
}

// Solid angles of all lights, virtual ones included, scaled to a mean of 1.
Vector solidAnglesOf(std::span<const Direction> lights,
                     const std::vector<Direction>& virtualLights) {
  std::vector<Direction> all(lights.begin(), lights.end());
  all.insert(all.end(), virtualLights.begin(), virtualLights.end());
  const std::vector<double> weights = solidAngleWeights(all, litCapOf(all));
  const Vector result =
      Eigen::Map<const Vector>(weights.data(), static_cast<Eigen::Index>(weights.size()));
  return result / result.mean();
}

LeastSquares problemFor(const AnalyticBasis& basis, const Matrix& basisAtLights,
                        std::span<const Direction> lights, bool weights, bool extension) {
  LeastSquares problem;
  problem.basis = basisAtLights;
  std::vector<Direction> virtualLights;
  if (extension) {
    const Extension step = extensionFor(basis, lights);
    virtualLights = step.directions;
    problem.virtualBasis = valuesAt(basis, virtualLights);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    problem.extension = Eigen::Map<const RowMajor>(
        step.matrix.data(), static_cast<Eigen::Index>(virtualLights.size()), step.lights);
  }
  if (weights) {
    const Vector all = solidAnglesOf(lights, virtualLights);
    problem.weights = all.head(static_cast<Eigen::Index>(lights.size()));
    problem.virtualWeights = all.tail(static_cast<Eigen::Index>(virtualLights.size()));
  }
  return problem;
}

Vector penaltyFor(const AnalyticBasis& basis, bool smooth) {
  return smooth ? roughness(basis) : Vector(Vector::Ones(basis.coefficients()));
}

std::vector<bool> possibilities(std::optional<bool> given) {
  return given ? std::vector<bool>{*given} : std::vector<bool>{false, true};
}

// Half decades.
std::vector<double> lambdaGrid() {
  std::vector<double> grid;
  for (int step = -14; step <= 1; ++step) grid.push_back(std::pow(10.0, step / 2.0));
  return grid;
}

// The penalties to be tried: (smooth, lambda).
std::vector<std::pair<bool, double>> penalties(const FitOptions& options) {
  if (options.regularizer) return {{false, *options.regularizer}};
  std::vector<std::pair<bool, double>> list;
  for (const bool smooth : {false, true}) {
    for (const double lambda : lambdaGrid()) list.emplace_back(smooth, lambda);
  }
  return list;
}

Matrix projectionMatrix(const AnalyticBasis& basis, std::span<const Direction> lights,
                        bool extension) {
  const std::vector<double> rows = projectionOperator(lights, basis, extension);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(rows.data(), basis.coefficients(),
                                    static_cast<Eigen::Index>(lights.size()));
}

void keepBetter(CoefficientChoice& best, const CoefficientMethod& method, Vector errors) {
  if (best.errors.size() == 0 || meanDecibels(errors) > meanDecibels(best.errors)) {
    best = {method, std::move(errors)};
  }
}

}  // namespace

std::string CoefficientMethod::text() const {
  const char* below = extension ? "with" : "without";
  if (projection) return fmt::format("projection by solid angles, {} extension", below);
  return fmt::format("least squares, {} solid-angle weights, {} extension, {} regularizer {:.2g}",
                     solidAngleWeights ? "with" : "without", below, smooth ? "smoothness" : "ridge",
                     lambda);
}

Matrix valuesAt(const AnalyticBasis& basis, std::span<const Direction> lights) {
  Matrix values(lights.size(), basis.coefficients());
  std::vector<double> row(static_cast<std::size_t>(basis.coefficients()));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    basis.evaluate(lights[i], row);
    for (int k = 0; k < basis.coefficients(); ++k) values(i, k) = row[k];
  }
  return values;
}

Matrix coefficientOperator(const AnalyticBasis& basis, const Matrix& basisAtLights,
                           std::span<const Direction> lights, const CoefficientMethod& method) {
  if (method.projection) return projectionMatrix(basis, lights, method.extension);
  const LeastSquares problem =
      problemFor(basis, basisAtLights, lights, method.solidAngleWeights, method.extension);
  return leastSquaresOperator(problem.normalMatrix(), problem.rightSide(),
                              penaltyFor(basis, method.smooth), method.lambda);
}

CoefficientChoice chooseMethod(const AnalyticBasis& basis, std::span<const Direction> lights,
                               const Matrix& gram, const FitOptions& options) {
  const Matrix values = valuesAt(basis, lights);
  CoefficientChoice best;
  for (const bool extension : possibilities(options.extension)) {
    if (options.projection) {
      const Matrix smoother = values * projectionMatrix(basis, lights, extension);
      keepBetter(best, {.projection = true, .extension = extension},
                 leaveOneOutErrors(smoother, gram));
      continue;
    }
    for (const bool weights : possibilities(options.solidAngleWeights)) {
      const LeastSquares problem = problemFor(basis, values, lights, weights, extension);
      const Matrix normal = problem.normalMatrix(), right = problem.rightSide();
      const Vector rough = penaltyFor(basis, true), even = penaltyFor(basis, false);
      for (const auto& [smooth, lambda] : penalties(options)) {
        const Matrix smoother =
            values * leastSquaresOperator(normal, right, smooth ? rough : even, lambda);
        keepBetter(best, {false, weights, extension, smooth, lambda},
                   leaveOneOutErrors(smoother, gram));
      }
    }
  }
  return best;
}

}  // namespace illum
