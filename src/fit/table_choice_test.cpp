#include "fit/table_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/test_lights.h"

namespace illum {
namespace {

// One column: cos(frequency * x) of the direction's x, with a plane of rms 0.5.
TableRequest waves(double frequency, double budget) {
  TableRequest request;
  request.columns = 1;
  request.values = [frequency](ChartPoint p, std::span<double> out) {
    out[0] = std::cos(frequency * directionFromChart(p).x());
  };
  request.planeMoments = Matrix::Constant(1, 1, 0.25);
  request.budget = budget;
  request.nodes = test::randomLights(300, 0);
  return request;
}

double errorOf(const BasisTable& table, const TableRequest& request) {
  double sum = 0;
  for (const Direction& d : request.nodes) {
    double exact = 0;
    float stored = 0;
    request.values(chartFromDirection(d), {&exact, 1});
    table.evaluate(d, {&stored, 1});
    sum += 0.25 * (stored - exact) * (stored - exact);
  }
  return sum / static_cast<double>(request.nodes.size());
}

TEST(ChooseTable, KeepsWithinTheBudgetAndItsStoredHalf) {
  for (const double frequency : {1.0, 6.0, 12.0}) {
    for (const double budget : {1e-3, 1e-5}) {
      const TableRequest request = waves(frequency, budget);
      EXPECT_LE(errorOf(chooseTable(request), request), 2 * budget) << frequency << ", " << budget;
    }
  }
}

TEST(ChooseTable, SmoothFunctionsTakeTheCoarsestTable) {
  EXPECT_EQ(chooseTable(waves(1, 1e-5)).resolution(), 17);
  EXPECT_GT(chooseTable(waves(25, 1e-5)).resolution(), 17);
}

TEST(ChooseTable, WhatNoneCanHoldTakesTheFinest) {
  EXPECT_EQ(chooseTable(waves(500, 1e-9)).resolution(), 49);
}

TEST(ChooseTable, IsWhatReadersSee) {
  BasisTable table = chooseTable(waves(6, 1e-5));
  EXPECT_EQ(BasisTable::decode(BasisTable(table).encode(), "again"), table);
}

}  // namespace
}  // namespace illum
