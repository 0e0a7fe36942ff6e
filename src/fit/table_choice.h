// How finely a light basis has to be sampled.
#pragma once

#include <functional>
#include <span>

#include "fit/dense.h"
#include "fit/light_weights.h"
#include "illum/basis_table.h"

namespace illum {

/// Functions to be sampled, and how much their errors matter.
struct TableRequest {
  LightDomain domain = LightDomain::Hemisphere;
  int columns = 0;
  /// As BasisTable::fillChart asks for it.
  std::function<void(ChartPoint, std::span<double>)> values;
  /// As AnalyticBasis says; if not, the guard ring is fitted.
  bool smoothAcrossEquator = true;
  /// columns x columns: second moments over pixels of what the columns are multiplied with (1 for a
  /// mean), 0 between columns that do not meet in one channel.
  Matrix planeMoments;
  /// Greatest mean square error of the picture (summed over channels, averaged over `nodes`).
  double budget = 0;
  std::vector<Direction> nodes;
};

/// The coarsest table of N in {17, 21, 25, 33, 49} whose interpolation keeps within the budget (the
/// finest if none does), with the stored precision set to keep within half of it again; encoded, so
/// that it holds what readers will see.
BasisTable chooseTable(const TableRequest& request);

}  // namespace illum
