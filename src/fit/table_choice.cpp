#include "fit/table_choice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "fit/bases/guard_ring.h"

namespace illum {
namespace {

constexpr std::array kResolutions{17, 21, 25, 33, 49};

Matrix exactValues(const TableRequest& request) {
  Matrix exact(request.nodes.size(), request.columns);
  std::vector<double> row(static_cast<std::size_t>(request.columns));
  for (std::size_t i = 0; i < request.nodes.size(); ++i) {
    request.values(chartFromDirection(request.nodes[i]), row);
    for (int c = 0; c < request.columns; ++c) exact(i, c) = row[c];
  }
  return exact;
}

double pictureError(const BasisTable& table, const TableRequest& request, const Matrix& exact) {
  std::vector<float> row(static_cast<std::size_t>(request.columns));
  Matrix errors = -exact;
  for (std::size_t i = 0; i < request.nodes.size(); ++i) {
    table.evaluate(request.nodes[i], row);
    for (int c = 0; c < request.columns; ++c) errors(i, c) += row[c];
  }
  const Matrix product = errors * request.planeMoments;
  return product.cwiseProduct(errors).sum() / static_cast<double>(errors.rows());
}

// Equal shares of half the budget; a column that nothing is multiplied with may be anything.
std::vector<double> storedErrors(const TableRequest& request) {
  const double share = std::sqrt(0.5 * request.budget / request.columns);
  const Vector planeRms = request.planeMoments.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double least = std::max(1e-6 * planeRms.maxCoeff(), 1e-12);
  std::vector<double> errors;
  for (const double rms : planeRms) errors.push_back(share / std::max(rms, least));
  return errors;
}

}  // namespace

BasisTable chooseTable(const TableRequest& request) {
  assert(request.planeMoments.rows() == request.columns && request.budget > 0);
  const Matrix exact = exactValues(request);
  BasisTable table;
  for (const int resolution : kResolutions) {
    table = BasisTable(request.domain, resolution, request.columns);
    if (request.smoothAcrossEquator) {
      table.fillChart(request.values);
    } else {
      fillWithFittedGuard(table, request.values);
    }
    if (pictureError(table, request, exact) <= request.budget) break;
  }
  table.setStoredErrors(storedErrors(request));
  table.encode();
  return table;
}

}  // namespace illum
