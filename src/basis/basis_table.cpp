#include "illum/basis_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "basis/catmull_rom.h"
#include "basis/chart.h"

namespace illum {
namespace {

// Azimuths over which the equator's mean is taken: several per cell of the finest usual table.
constexpr int kEquatorSamples = 1024;

}  // namespace

BasisTable::BasisTable(LightDomain domain, int resolution, int columns)
    : domain_(domain), resolution_(resolution), columns_(columns) {
  assert(resolution >= 4 && columns >= 1);
  values_.resize(static_cast<std::size_t>(squares()) * columns_ * side() * side());
  if (domain_ == LightDomain::Hemisphere) southPole_.resize(columns_);
}

void BasisTable::fill(const std::function<void(Direction, std::span<double>)>& f) {
  fillChart([&](ChartPoint p, std::span<double> out) { f(directionFromChart(p), out); });
}

void BasisTable::fillChart(const std::function<void(ChartPoint, std::span<double>)>& f) {
  const std::vector<std::uint8_t> reachable = reachableSamples(resolution_);
  const std::size_t samples = reachable.size();
  std::vector<double> column(columns_);
  for (int square = 0; square < squares(); ++square) {
    float* out = values_.data() + static_cast<std::size_t>(square) * columns_ * samples;
    for (std::size_t s = 0; s < samples; ++s) {
      std::fill(column.begin(), column.end(), 0.0);
      if (reachable[s] != 0) {
        const double x = (static_cast<double>(s % side()) - 1) / (resolution_ - 1);
        const double y = (static_cast<double>(s / side()) - 1) / (resolution_ - 1);
        f({square, x, y}, column);
      }
      for (int c = 0; c < columns_; ++c) out[c * samples + s] = static_cast<float>(column[c]);
    }
  }
  setSouthPoleFromEquator();
}

void BasisTable::setSouthPoleFromEquator() {
  if (domain_ == LightDomain::Sphere) return;
  std::vector<double> sum(columns_, 0.0);
  std::vector<float> value(columns_);
  for (int i = 0; i < kEquatorSamples; ++i) {
    const double phi = 2 * std::numbers::pi * i / kEquatorSamples;
    evaluate(ChartPoint{0, 0.5 + 0.5 * std::cos(phi), 0.5 + 0.5 * std::sin(phi)}, value);
    for (int c = 0; c < columns_; ++c) sum[c] += value[c];
  }
  for (int c = 0; c < columns_; ++c) southPole_[c] = static_cast<float>(sum[c] / kEquatorSamples);
}

void BasisTable::evaluate(ChartPoint p, std::span<float> out) const {
  const CellCoordinate x = cellCoordinate(p.x, resolution_), y = cellCoordinate(p.y, resolution_);
  const std::size_t rowStride = side(), columnStride = rowStride * side();
  const float* base = values_.data() +
                      static_cast<std::size_t>(p.square) * columns_ * columnStride +
                      static_cast<std::size_t>(y.cell) * rowStride + x.cell;
  for (int c = 0; c < columns_; ++c, base += columnStride) {
    double sum = 0;
    for (int j = 0; j < 4; ++j) {
      const float* row = base + j * rowStride;
      sum += y.weights[j] * (x.weights[0] * row[0] + x.weights[1] * row[1] + x.weights[2] * row[2] +
                             x.weights[3] * row[3]);
    }
    out[c] = static_cast<float>(sum);
  }
}

void BasisTable::evaluate(Direction d, std::span<float> out) const {
  assert(out.size() == static_cast<std::size_t>(columns_));
  if (domain_ == LightDomain::Sphere || d.z() >= 0) {
    evaluate(chartFromDirection(d), out);
    return;
  }
  const BelowHorizon below = belowHorizon(d);
  if (below.southPole == 1) {
    std::copy(southPole_.begin(), southPole_.end(), out.begin());
    return;
  }
  evaluate(below.equator, out);
  for (int c = 0; c < columns_; ++c) {
    out[c] = static_cast<float>((1 - below.southPole) * out[c] + below.southPole * southPole_[c]);
  }
}

void BasisTable::setStoredError(double relative) {
  assert(relative > 0);
  storedError_ = relative;
  storedErrors_.clear();
  encoded_.clear();
}

void BasisTable::setStoredErrors(std::vector<double> absolutePerColumn) {
  assert(absolutePerColumn.size() == static_cast<std::size_t>(columns_));
  storedErrors_ = std::move(absolutePerColumn);
  encoded_.clear();
}

bool operator==(const BasisTable& a, const BasisTable& b) {
  return a.domain_ == b.domain_ && a.resolution_ == b.resolution_ && a.columns_ == b.columns_ &&
         a.values_ == b.values_ && a.southPole_ == b.southPole_;
}

}  // namespace illum
