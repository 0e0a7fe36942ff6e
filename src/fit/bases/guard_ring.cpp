#include "fit/bases/guard_ring.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "basis/chart.h"
#include "fit/dense.h"

namespace illum {
namespace {

// Points a cell's side at which interpolation is compared with the function.
constexpr int kPointsPerSide = 6;
// Of the normal matrix's mean diagonal: enough to settle samples that hardly any point depends on.
constexpr double kPriorWeight = 1e-3;

// BasisTable interpolates by a cardinal kernel: the weight of a sample at a distance in grid steps
// (R. Keys 1981, with a = -1/2, which is Catmull and Rom's).
double kernel(double distance) {
  const double t = std::abs(distance);
  if (t >= 2) return 0;
  if (t >= 1) return ((-0.5 * t + 2.5) * t - 4) * t + 2;
  return (1.5 * t - 2.5) * t * t + 1;
}

// Normal equations for the samples beyond the equator.
class GuardFit {
 public:
  GuardFit(BasisTable& table, const std::function<void(ChartPoint, std::span<double>)>& f)
      : table_(table), f_(f), side_(table.side()), columns_(table.columns()) {
    const std::vector<std::uint8_t> reachable = reachableSamples(table.resolution());
    number_.assign(reachable.size(), -1);
    for (int row = 0; row < side_; ++row) {
      for (int column = 0; column < side_; ++column) {
        const bool beyond = radius(column - 1, row - 1) > 1 + 1e-12;
        if (beyond && reachable[index(row, column)]) number_[index(row, column)] = unknowns_++;
      }
    }
    normal_ = Matrix::Zero(unknowns_, unknowns_);
    right_ = Matrix::Zero(unknowns_, columns_);
  }

  void solve() {
    const int cells = table_.resolution() - 1;
    for (int row = 0; row < cells; ++row) {
      for (int column = 0; column < cells; ++column) {
        if (dependsOnGuard(row, column)) addCell(row, column);
      }
    }
    addPrior();
    const Matrix solution = solveSymmetric(normal_, right_);
    forUnknowns([&](int unknown, int c, float& value) {
      value = static_cast<float>(solution(unknown, c));
    });
    table_.setSouthPoleFromEquator();
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * side_ + column;
  }
  // Of a place in grid steps from the square's corner, in units of the disc's radius.
  double radius(double x, double y) const {
    const double half = (table_.resolution() - 1) / 2.0;
    return std::hypot(x - half, y - half) / half;
  }
  float& sample(int column, std::size_t at) {
    return table_.values()[static_cast<std::size_t>(column) * number_.size() + at];
  }
  bool dependsOnGuard(int row, int column) const {
    for (int k = 0; k < 16; ++k) {
      if (number_[index(row + k / 4, column + k % 4)] >= 0) return true;
    }
    return false;
  }

  void addCell(int row, int column) {
    for (int k = 0; k < kPointsPerSide * kPointsPerSide; ++k) {
      const double x = column + (k % kPointsPerSide + 0.5) / kPointsPerSide;
      const double y = row + (k / kPointsPerSide + 0.5) / kPointsPerSide;
      if (radius(x, y) <= 1) addPoint(row, column, x, y);
    }
  }

  // One equation: the guard's share of the interpolated value is f less the inner samples' share.
  void addPoint(int row, int column, double x, double y) {
    const double steps = table_.resolution() - 1;
    std::vector<double> rest(columns_);
    f_({0, x / steps, y / steps}, rest);
    std::array<std::pair<int, double>, 16> guard;
    int guards = 0;
    for (int k = 0; k < 16; ++k) {
      const int r = row + k / 4, c = column + k % 4;
      const double weight = kernel(c - 1 - x) * kernel(r - 1 - y);
      const std::size_t at = index(r, c);
      if (number_[at] >= 0) {
        guard[guards++] = {number_[at], weight};
      } else {
        for (int j = 0; j < columns_; ++j) rest[j] -= weight * sample(j, at);
      }
    }
    // Solid angle of an area of the chart: the stereographic scale's square.
    const double scale = 1 + radius(x, y) * radius(x, y), area = 1 / (scale * scale);
    for (int a = 0; a < guards; ++a) {
      const auto [unknown, weight] = guard[a];
      for (int b = 0; b < guards; ++b) {
        normal_(unknown, guard[b].first) += area * weight * guard[b].second;
      }
      for (int j = 0; j < columns_; ++j) right_(unknown, j) += area * weight * rest[j];
    }
  }

  void addPrior() {
    const double prior = kPriorWeight * normal_.trace() / unknowns_;
    normal_.diagonal().array() += prior;
    forUnknowns([&](int unknown, int c, float& value) { right_(unknown, c) += prior * value; });
  }

  template <typename Visit>
  void forUnknowns(const Visit& visit) {
    for (std::size_t at = 0; at < number_.size(); ++at) {
      if (number_[at] < 0) continue;
      for (int c = 0; c < columns_; ++c) visit(number_[at], c, sample(c, at));
    }
  }

  BasisTable& table_;
  const std::function<void(ChartPoint, std::span<double>)>& f_;
  int side_, columns_, unknowns_ = 0;
  std::vector<int> number_;  ///< of each sample among the unknowns, or -1
  Matrix normal_, right_;
};

}  // namespace

void fillWithFittedGuard(BasisTable& table,
                         const std::function<void(ChartPoint, std::span<double>)>& f) {
  assert(table.domain() == LightDomain::Hemisphere);
  table.fillChart(f);
  GuardFit(table, f).solve();
}

}  // namespace illum
